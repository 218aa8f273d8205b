#include "machine_errors/error_rows.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/circle/recording.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

constexpr double kFine_deg = 0.4;  // between the first and the last of its readings
constexpr double kRow_deg = 1.0;
constexpr double kOfAll = -1.0;  // index of the recording of an effect: all of them

// Which stretch of the path a reading is of: rows never hold two.
struct Stretch {
  double recording = -1.0;
  double quarter = 0.0;
  bool at_reversal = false;
  bool near_reversal = false;
  bool operator==(const Stretch&) const = default;
};

Stretch stretch_of(double recording, double angle_deg) {
  const double quarter = std::floor(angle_deg / 90.0);
  const double within_deg = angle_deg - 90.0 * quarter;
  const double from_deg = std::min(within_deg, 90.0 - within_deg);
  return {recording, quarter, from_deg <= kAtReversal_deg, from_deg <= kNearReversal_deg};
}

// The row of each: a new one where the stretch changes, or where it would be longer than this. At a reversal, where a
// step may take a part of a degree, each reading has a row.
std::vector<std::size_t> joined(std::span<const double> recording, std::span<const double> angle_rad,
                                double longest_deg, double near_reversal_deg) {
  std::vector<std::size_t> rows(angle_rad.size());
  Stretch last;
  double first_deg = 0.0;
  std::size_t row = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double angle_deg = deg_from_rad(angle_rad[i]);
    const Stretch stretch = stretch_of(recording[i], angle_deg);
    const double longest = stretch.at_reversal ? 0.0 : stretch.near_reversal ? near_reversal_deg : longest_deg;
    if (i > 0 && (stretch != last || std::abs(angle_deg - first_deg) > longest)) ++row;
    if (i == 0 || row != rows[i - 1]) first_deg = angle_deg;
    rows[i] = row;
    last = stretch;
  }
  return rows;
}

EffectRows rows_of(const Effect& effect, const Series& fine) {
  EffectRows rows{fine.time_s, {}};
  for (const Input& input : effect.inputs)
    rows.inputs.emplace_back(find_column(fine, trace_column(input.role))->values);
  return rows;
}

}  // namespace

double from_reversal_deg(double angle_rad, double reversal_deg) {
  const double angle_deg = deg_from_rad(angle_rad) - reversal_deg;
  return std::abs(angle_deg - 180.0 * std::round(angle_deg / 180.0));
}

double since_reversal_deg(const ErrorRows& rows, Eigen::Index row, double reversal_deg) {
  const double travelled_deg = rows.direction[row] * (deg_from_rad(rows.angle_rad[row]) - reversal_deg);
  return travelled_deg - 180.0 * std::floor(travelled_deg / 180.0);
}

Eigen::VectorXd ErrorRows::mean(std::span<const double> of_fine) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(size());
  for (std::size_t i = 0; i < of_fine.size(); ++i) {
    sum[static_cast<Eigen::Index>(row_of[i])] += fine_count[static_cast<Eigen::Index>(i)] * of_fine[i];
  }
  return sum.cwiseQuotient(count);
}

Eigen::MatrixXd ErrorRows::means(const Eigen::MatrixXd& of_fine) const {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(size(), of_fine.cols());
  // Row by row: sums of one column wait for one another, those of several do not.
  for (Eigen::Index i = 0; i < of_fine.rows(); ++i) {
    const auto row = static_cast<Eigen::Index>(row_of[static_cast<std::size_t>(i)]);
    const double readings = fine_count[i];
    for (Eigen::Index k = 0; k < of_fine.cols(); ++k) sums(row, k) += readings * of_fine(i, k);
  }
  sums.array().colwise() /= count.array();
  return sums;
}

ErrorRows error_rows(const Series& trace) {
  ErrorRows rows;
  const std::vector<double>& recording = find_column(trace, trace_column("recording"))->values;
  const std::vector<double>& angle_rad = find_column(trace, trace_column("angle"))->values;
  rows.fine_of = joined(recording, angle_rad, kFine_deg, kFine_deg);
  const std::size_t n = rows.fine_of.empty() ? 0 : rows.fine_of.back() + 1;
  rows.fine_count = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
  for (const std::size_t row : rows.fine_of) rows.fine_count[static_cast<Eigen::Index>(row)] += 1.0;
  const auto mean_of = [&](const std::vector<double>& values) {
    std::vector<double> means(n, 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) means[rows.fine_of[i]] += values[i];
    for (std::size_t i = 0; i < n; ++i) means[i] /= rows.fine_count[static_cast<Eigen::Index>(i)];
    return means;
  };
  rows.fine.time_s = mean_of(trace.time_s);
  rows.fine.columns.reserve(trace.columns.size());
  for (const Column& column : trace.columns) {
    rows.fine.columns.push_back({column.name, column.role, mean_of(column.values)});
  }
  const std::vector<double>& fine_recording = find_column(rows.fine, trace_column("recording"))->values;
  const std::vector<double>& fine_angle_rad = find_column(rows.fine, trace_column("angle"))->values;
  // Of means: half a fine row at either end less.
  rows.row_of = joined(fine_recording, fine_angle_rad, kRow_deg - kFine_deg, 0.0);
  rows.count = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.row_of.empty() ? 0 : rows.row_of.back() + 1));
  rows.recording.resize(static_cast<std::size_t>(rows.count.size()));
  for (std::size_t i = 0; i < n; ++i) {
    rows.count[static_cast<Eigen::Index>(rows.row_of[i])] += rows.fine_count[static_cast<Eigen::Index>(i)];
    rows.recording[rows.row_of[i]] = static_cast<std::size_t>(fine_recording[i]);
  }
  rows.recordings = rows.recording.empty() ? 0 : rows.recording.back() + 1;
  rows.interval_s = Eigen::VectorXd::Zero(rows.count.size());
  for (std::size_t first = 0; first < recording.size();) {
    std::size_t last = first;
    while (last + 1 < recording.size() && recording[last + 1] == recording[first]) ++last;
    const double interval_s =
        (trace.time_s[last] - trace.time_s[first]) / static_cast<double>(std::max<std::size_t>(last - first, 1));
    for (Eigen::Index i = 0; i < rows.count.size(); ++i) {
      if (rows.recording[static_cast<std::size_t>(i)] == static_cast<std::size_t>(recording[first])) {
        rows.interval_s[i] = interval_s;
      }
    }
    first = last + 1;
  }
  rows.time_s = rows.mean(rows.fine.time_s);
  rows.angle_rad = rows.mean(fine_angle_rad);
  rows.direction = rows.mean(find_column(rows.fine, trace_column("direction"))->values);
  rows.deviation_um = rows.mean(find_column(rows.fine, "deviation_um")->values);
  rows.from_reversal_deg = rows.angle_rad.unaryExpr(
      [](double angle) { return std::min(from_reversal_deg(angle, 0.0), from_reversal_deg(angle, 90.0)); });
  return rows;
}

ErrorRows rows_at(const ErrorRows& rows, const std::vector<Eigen::Index>& which) {
  ErrorRows some;
  some.recordings = rows.recordings;
  for (const auto& [from, to] : {std::pair{&rows.count, &some.count},
                                 {&rows.interval_s, &some.interval_s},
                                 {&rows.time_s, &some.time_s},
                                 {&rows.angle_rad, &some.angle_rad},
                                 {&rows.direction, &some.direction},
                                 {&rows.deviation_um, &some.deviation_um},
                                 {&rows.from_reversal_deg, &some.from_reversal_deg}}) {
    *to = (*from)(which);
  }
  constexpr auto kOther = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(static_cast<std::size_t>(rows.size()), kOther);
  some.recording.reserve(which.size());
  for (const Eigen::Index row : which) {
    place[static_cast<std::size_t>(row)] = some.recording.size();
    some.recording.push_back(rows.recording[static_cast<std::size_t>(row)]);
  }
  std::vector<std::size_t> fine;  // those of the rows
  fine.reserve(rows.row_of.size());
  for (std::size_t i = 0; i < rows.row_of.size(); ++i) {
    if (place[rows.row_of[i]] == kOther) continue;
    fine.push_back(i);
    some.row_of.push_back(place[rows.row_of[i]]);
  }
  const auto values_at = [&](const std::vector<double>& values) {
    std::vector<double> at;
    at.reserve(fine.size());
    for (const std::size_t i : fine) at.push_back(values[i]);
    return at;
  };
  some.fine_count = rows.fine_count(fine);
  some.fine.time_s = values_at(rows.fine.time_s);
  some.fine.columns.reserve(rows.fine.columns.size());
  for (const Column& column : rows.fine.columns) {
    some.fine.columns.push_back({column.name, column.role, values_at(column.values)});
  }
  return some;
}

std::vector<std::size_t> gains_of(const Effect& effect) {
  std::vector<std::size_t> gains;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (effect.parameters[k].kind == ParameterKind::gain) gains.push_back(k);
  }
  return gains;
}

std::size_t shape_of(const Effect& effect) {
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (effect.parameters[k].kind == ParameterKind::shape) return k;
  }
  return kNoShape;
}

Eigen::MatrixXd unit_curves(const Effect& effect, const Series& fine, double shape) {
  const EffectRows rows = rows_of(effect, fine);
  std::vector<double> parameters;
  parameters.reserve(effect.parameters.size());
  for (const Parameter& parameter : effect.parameters) {
    const bool is_recording = parameter.shape_of == ShapeOf::recording;
    parameters.push_back(parameter.kind == ParameterKind::gain ? 0.0 : is_recording ? kOfAll : shape);
  }
  const auto n = static_cast<Eigen::Index>(fine.time_s.size());
  const auto all = static_cast<Eigen::Index>(parameters.size());
  std::vector<double> values(fine.time_s.size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> derivatives(n, all);
  effect.evaluate(rows, parameters.data(), values.data(), derivatives.data());
  return derivatives(Eigen::all, gains_of(effect));
}

UnitCurves::UnitCurves(const Effect& effect, const Series& fine) : effect_(effect), fine_(fine) {
  if (!effect.evaluate.unit_curves) return;
  fast_ = effect.evaluate.unit_curves(rows_of(effect, fine));
  curves_.resize(static_cast<Eigen::Index>(fine.time_s.size()), static_cast<Eigen::Index>(gains_of(effect).size()));
}

const Eigen::MatrixXd& UnitCurves::at(double shape) {
  if (fast_) {
    fast_(shape, curves_.data());
  } else {
    curves_ = unit_curves(effect_, fine_, shape);
  }
  return curves_;
}

}  // namespace ballbar
