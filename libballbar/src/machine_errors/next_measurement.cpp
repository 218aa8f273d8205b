#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_design.hpp"

namespace ballbar {
namespace {

constexpr double kAlike = 0.02, kApart = 0.1;  // share of an error's square that the others do not imitate
constexpr double kClearly = 1.5;               // of ratios: equal but for rounding below it
constexpr double kMostRecordings = 24.0;       // each has three columns of its own

// The gains of the circles, then those of the effects.
struct SeparatedErrors {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance;
  Eigen::ArrayXd own;  // share of each; infinite: not in the readings
  Eigen::Index circles = 0;
};

SeparatedErrors separated_errors(const Series& trace, std::span<const ShapedEffect> effects) {
  const ErrorRows rows = error_rows(trace);
  const Eigen::VectorXd far = far_weight(rows);
  std::vector<EffectDesign> all{weighted(FittedEffect(), circle_columns(rows), far)};
  for (const ShapedEffect& one : effects) {
    ErrorColumns columns = effect_columns(*one.effect, one.shape, rows, false);
    // What depends on an input that is not stated is not in the readings.
    columns.values = columns.values.array().isNaN().select(0.0, columns.values).eval();
    FittedEffect fitted;
    fitted.effect = one.effect;
    all.push_back(weighted(std::move(fitted), std::move(columns), far));
  }
  ErrorDesign design;
  add(design, all);
  SeparatedErrors found;
  found.circles = all.front().x.size();
  for (const ErrorColumn& one : design.x.columns)
    found.names.push_back(one.effect == nullptr ? one.name : one.effect->name);
  found.covariance = inverse_of(design.products);
  found.own = (design.products.diagonal().array() * found.covariance.diagonal().array()).inverse();
  return found;
}

// Whether no recording of the trace is such a measurement.
bool is_new(Measurement measurement, const Series& trace) {
  const double arc_rad = longest_arc_rad(trace);
  if (measurement == Measurement::full_circle) return arc_rad >= kShortestArc_rad && arc_rad < kFullTurn_rad;
  if (measurement == Measurement::another_feed) return true;
  const std::vector<double>& direction = find_column(trace, trace_column("direction"))->values;
  return std::all_of(direction.begin(), direction.end(), [&](double one) { return one == direction.front(); });
}

// The trace with each of its recordings once more, as this measurement has it. What is measured stays as it is.
Series with_measurement(Measurement measurement, const Series& trace) {
  const std::vector<double>& recording = find_column(trace, trace_column("recording"))->values;
  const std::vector<double>& direction = find_column(trace, trace_column("direction"))->values;
  const double sign = measurement == Measurement::other_direction ? -1.0 : 1.0;
  const double faster = measurement == Measurement::another_feed ? 2.0 : 1.0;
  const double turns = measurement == Measurement::full_circle ? 2.0 * kPi / longest_arc_rad(trace) : 1.0;
  Series more = trace;
  double number = recording.back();
  for (std::size_t first = 0, last = 0; first < recording.size(); first = last) {
    while (last < recording.size() && recording[last] == recording[first]) ++last;
    const double readings = static_cast<double>(last - first);
    const auto count = static_cast<std::size_t>(std::lround(turns * readings));
    ++number;
    for (std::size_t i = 0; i < count; ++i) {
      const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      const std::size_t row = first + static_cast<std::size_t>((sign < 0.0 ? 1.0 - at : at) * readings);
      more.time_s.push_back(more.time_s.back() + 1.0);
      for (Column& column : more.columns) {
        double value = column.values[row];
        if (column.name == trace_column("recording")) value = number;
        if (column.name == trace_column("direction")) value *= sign;
        if (column.name == trace_column("sweep")) value *= sign * turns / faster;
        if (column.name == trace_column("feed")) value *= faster;
        if (turns > 1.0 && column.name == trace_column("angle")) value = 2.0 * kPi * at * direction[row];
        column.values.push_back(value);
      }
    }
  }
  return more;
}

}  // namespace

std::string_view name_of(Measurement measurement) {
  constexpr std::array<std::string_view, 3> kNames{"other_direction", "full_circle", "another_feed"};
  return kNames[static_cast<std::size_t>(measurement)];
}

std::optional<NextMeasurement> next_measurement(const Series& trace, std::span<const ShapedEffect> effects) {
  if (effects.empty() || find_column(trace, trace_column("recording"))->values.back() >= kMostRecordings) return {};
  const SeparatedErrors now = separated_errors(trace, effects);
  const Eigen::ArrayXd before = now.own.tail(now.own.size() - now.circles);
  for (const Measurement measurement :
       {Measurement::other_direction, Measurement::full_circle, Measurement::another_feed}) {
    if (!(before < kAlike).any() || !is_new(measurement, trace)) continue;
    const Eigen::ArrayXd after =
        separated_errors(with_measurement(measurement, trace), effects).own.tail(before.size());
    Eigen::Index best = -1, other = -1;
    double most = 0.0, closest = 0.0;
    for (Eigen::Index k = 0; k < before.size(); ++k) {
      if (before[k] >= kAlike || after[k] < kApart || after[k] < kClearly * most * before[k]) continue;
      best = now.circles + k;
      most = after[k] / before[k];
    }
    if (best < 0) continue;
    // The one that goes with it most.
    const auto name = [&](Eigen::Index k) { return now.names[static_cast<std::size_t>(k)]; };
    for (Eigen::Index k = 0; k < now.own.size(); ++k) {
      const double square = now.covariance(best, k) * now.covariance(best, k) / now.covariance(k, k);
      if (name(k) == name(best) || square <= kClearly * closest) continue;
      other = k;
      closest = square;
    }
    if (other >= 0) return NextMeasurement{measurement, name(best), name(other)};
  }
  return std::nullopt;
}

}  // namespace ballbar
