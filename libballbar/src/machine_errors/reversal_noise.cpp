#include "machine_errors/reversal_noise.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

constexpr double kClearExcess = 1.5;  // of variances

// The joined row of each quiet one; -1: it is not quiet.
std::vector<Eigen::Index> joined_row_of(const ErrorRows& rows) {
  std::vector<Eigen::Index> joined(static_cast<std::size_t>(rows.size()), -1);
  Eigen::Index row = -1;
  Eigen::Index first = -2;  // of the joined row
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] <= kNearReversal_deg) continue;
    const auto at = static_cast<std::size_t>(i);
    const bool second = first == i - 1 && rows.recording[at] == rows.recording[at - 1];
    if (!second) {
      ++row;
      first = i;
    } else {
      first = -2;
    }
    joined[at] = row;
  }
  return joined;
}

}  // namespace

QuietRows quiet_rows(const ErrorRows& rows, const Eigen::MatrixXd& columns) {
  const std::vector<Eigen::Index> joined = joined_row_of(rows);
  Eigen::Index n = 0;
  for (const Eigen::Index row : joined) n = std::max(n, row + 1);
  QuietRows quiet;
  ErrorRows& of = quiet.rows;
  of.count = of.time_s = of.angle_rad = of.interval_s = of.deviation_um = Eigen::VectorXd::Zero(n);
  of.recording.resize(static_cast<std::size_t>(n));
  of.recordings = rows.recordings;
  quiet.columns = Eigen::MatrixXd::Zero(n, columns.cols());
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const Eigen::Index row = joined[static_cast<std::size_t>(i)];
    if (row < 0) continue;
    of.count[row] += rows.count[i];
    of.time_s[row] += rows.count[i] * rows.time_s[i];
    of.angle_rad[row] += rows.count[i] * rows.angle_rad[i];
    of.deviation_um[row] += rows.count[i] * rows.deviation_um[i];
    of.interval_s[row] = rows.interval_s[i];
    of.recording[static_cast<std::size_t>(row)] = rows.recording[static_cast<std::size_t>(i)];
    quiet.columns.row(row) += rows.count[i] * columns.row(i);
  }
  for (Eigen::VectorXd* sum : {&of.time_s, &of.angle_rad, &of.deviation_um}) *sum = sum->cwiseQuotient(of.count);
  quiet.columns.array().colwise() /= of.count.array();
  return quiet;
}

Eigen::VectorXd excess_of(const ErrorRows& rows, const Eigen::VectorXd& residual) {
  // Of the four reversals each, and of all rows that are near none.
  constexpr std::size_t kReversals = 4;
  const auto place_of = [&](Eigen::Index i) {
    if (rows.from_reversal_deg[i] > kNearReversal_deg) return kReversals;
    return static_cast<std::size_t>(std::llround(deg_from_rad(rows.angle_rad[i]) / 90.0) % 4 + 4) % kReversals;
  };
  std::array<double, kReversals + 1> squares{}, count{};
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    squares[place_of(i)] += rows.count[i] * residual[i] * residual[i];
    count[place_of(i)] += rows.count[i];
  }
  Eigen::VectorXd excess = Eigen::VectorXd::Ones(rows.size());
  if (!(squares[kReversals] > 0.0)) return excess;
  const double quiet = squares[kReversals] / count[kReversals];
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const std::size_t place = place_of(i);
    const double ratio = place == kReversals ? 1.0 : squares[place] / count[place] / quiet;
    if (ratio >= kClearExcess) excess[i] = std::sqrt(ratio);
  }
  return excess;
}

}  // namespace ballbar
