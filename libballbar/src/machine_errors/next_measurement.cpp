#include "ballbar/machine_errors/next_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "ballbar/circle/trace.hpp"
#include "machine_errors/error_blocks.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {
namespace {

constexpr double kAlike = 0.02, kApart = 0.1;  // share of an error's square that the others do not imitate
constexpr double kClearly = 1.5;               // of ratios: equal but for rounding below it

// The circles and the effects fitted together, with the share of each column that is its own.
struct SeparatedErrors {
  std::vector<ErrorColumn> columns;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd own;

  double own_of(const ErrorColumn& column) const {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k].effect == column.effect && columns[k].gain == column.gain) return own[static_cast<Eigen::Index>(k)];
    }
    return 0.0;
  }
};

SeparatedErrors separated_errors(const Series& trace, std::span<const ShapedEffect> effects) {
  const ErrorRows rows = error_rows(trace);
  const Eigen::VectorXd far =
      rows.count.cwiseProduct((rows.from_reversal_deg.array() > kAtReversal_deg).cast<double>().matrix());
  std::vector<ErrorColumns> parts{circle_columns(rows)};
  for (const ShapedEffect& one : effects) {
    parts.push_back(present(effect_columns(*one.effect, one.shape, rows, false), far));
  }
  std::vector<const ErrorColumns*> all;
  for (const ErrorColumns& part : parts) all.push_back(&part);
  ErrorColumns together = joined(all, rows);
  const Block block = block_of(together.values, far, {});
  const Eigen::VectorXd own = block.normal.diagonal().cwiseProduct(block.inverse.diagonal()).cwiseInverse();
  return {std::move(together.columns), block.inverse, own};
}

// Whether no recording of the trace is such a measurement.
bool is_new(Measurement measurement, const Series& trace) {
  if (measurement == Measurement::full_circle) return longest_arc_rad(trace) < kFullTurn_rad;
  if (measurement == Measurement::another_feed) return true;
  const std::vector<double>& direction = find_column(trace, trace_column("direction"))->values;
  return std::adjacent_find(direction.begin(), direction.end(), std::not_equal_to<>()) == direction.end();
}

// The trace with each of its recordings once more, as this measurement has it. What is measured stays as it is.
Series with_measurement(Measurement measurement, const Series& trace) {
  const std::vector<double>& recording = find_column(trace, trace_column("recording"))->values;
  const std::vector<double>& direction = find_column(trace, trace_column("direction"))->values;
  const double sign = measurement == Measurement::other_direction ? -1.0 : 1.0;
  const double turns = measurement == Measurement::full_circle ? 2.0 * kPi / longest_arc_rad(trace) : 1.0;
  const double faster = measurement == Measurement::another_feed ? 2.0 : 1.0;
  Series more = trace;
  double number = recording.back();
  for (std::size_t first = 0, last = 0; first < recording.size(); first = last) {
    while (last < recording.size() && recording[last] == recording[first]) ++last;
    const double readings = static_cast<double>(last - first);
    const auto count = static_cast<std::size_t>(std::lround(turns * readings));
    ++number;
    for (std::size_t i = 0; i < count; ++i) {
      const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      const std::size_t step = std::min(static_cast<std::size_t>(at * readings), last - first - 1);
      const std::size_t row = sign < 0.0 ? last - 1 - step : first + step;
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
  return measurement == Measurement::other_direction ? "other_direction"
         : measurement == Measurement::full_circle   ? "full_circle"
                                                     : "another_feed";
}

std::optional<NextMeasurement> next_measurement(const Series& trace, std::span<const ShapedEffect> effects) {
  const SeparatedErrors now = separated_errors(trace, effects);
  const auto name_at = [&](std::size_t k) {
    return now.columns[k].effect == nullptr ? now.columns[k].name : now.columns[k].effect->name;
  };
  std::vector<std::size_t> alike;
  for (std::size_t k = 0; k < now.columns.size(); ++k) {
    if (now.columns[k].effect != nullptr && now.own[static_cast<Eigen::Index>(k)] < kAlike) alike.push_back(k);
  }
  for (const Measurement measurement :
       {Measurement::other_direction, Measurement::full_circle, Measurement::another_feed}) {
    if (alike.empty() || !is_new(measurement, trace)) continue;
    const SeparatedErrors then = separated_errors(with_measurement(measurement, trace), effects);
    std::optional<std::size_t> best;
    double most = 0.0;
    for (const std::size_t k : alike) {
      const double after = then.own_of(now.columns[k]), rise = after / now.own[static_cast<Eigen::Index>(k)];
      if (after < kApart || rise < kClearly * most) continue;
      best = k;
      most = rise;
    }
    if (!best) continue;
    // The one that goes with it most.
    std::size_t other = *best;
    double closest = 0.0;
    for (std::size_t k = 0; k < now.columns.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(*best), j = static_cast<Eigen::Index>(k);
      const double square = now.covariance(i, j) * now.covariance(i, j) / now.covariance(j, j) / now.covariance(i, i);
      if (name_at(k) == name_at(*best) || square < kClearly * closest) continue;
      other = k;
      closest = square;
    }
    return NextMeasurement{measurement, name_at(*best), name_at(other)};
  }
  return std::nullopt;
}

}  // namespace ballbar
