#include "diagnosis/statistics/outliers.hpp"

#include <algorithm>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/series/speed_steps.hpp"
#include "noise/whitening.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

// Of each row of the data: whether it lies shortly after a change of speed.
std::vector<bool> after_changes(const Series& data) {
  std::vector<bool> after(data.time_s.size(), false);
  for (const Column& column : data.columns) {
    if (column.role != Role::speed) continue;
    const std::vector<SpeedStep> steps = speed_steps(data.time_s, column);
    for (std::size_t s = 1; s < steps.size(); ++s) {
      for (std::size_t row = steps[s].begin; row < steps[s].end; ++row) {
        if (data.time_s[row] - data.time_s[steps[s].begin] <= kAfterChange_s) after[row] = true;
      }
    }
  }
  return after;
}

}  // namespace

Outliers outliers(const Eigen::VectorXd& white, const Series& data, const std::vector<std::size_t>& rows) {
  const Eigen::VectorXd kept = clipped(white);
  const std::vector<bool> after = after_changes(data);
  Outliers result;
  std::size_t rows_after = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const bool is_after = after[rows[i]];
    rows_after += is_after ? 1 : 0;
    if (kept[at] == white[at]) continue;
    ++result.count;
    result.after_changes += is_after ? 1 : 0;
  }
  const double share = static_cast<double>(rows_after) / static_cast<double>(std::max<std::size_t>(1, rows.size()));
  result.p = binomial_upper_tail(result.after_changes, result.count, share);
  return result;
}

}  // namespace ballbar
