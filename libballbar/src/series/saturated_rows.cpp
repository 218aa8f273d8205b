#include "series/saturated_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "series/equal_rows.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsBeforeEnd = 5;

}  // namespace

std::vector<std::size_t> saturated_rows(const std::vector<double>& values, const SaturationLimits& limits) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  std::vector<std::size_t> rows;
  std::vector<double> before;
  for (const auto& [begin, end] : equal_rows(values)) {
    if (begin == 0 || end - begin < limits.fewest_rows) continue;
    if (values[begin] != *low && values[begin] != *high) continue;
    for (std::size_t row = begin; row < end; ++row) rows.push_back(row);
    for (std::size_t row = begin - std::min(begin - 1, kRowsBeforeEnd); row < begin; ++row)
      before.push_back(std::abs(values[row] - values[row - 1]));
  }
  if (static_cast<double>(rows.size()) < limits.least_share * static_cast<double>(values.size()) || before.empty())
    return {};
  std::vector<double> changes;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] != values[i - 1]) changes.push_back(std::abs(values[i] - values[i - 1]));
  }
  if (changes.size() < limits.fewest_changes) return {};
  const double resolution = *std::min_element(changes.begin(), changes.end());
  return median(std::move(before)) > limits.small_step * resolution ? rows : std::vector<std::size_t>{};
}

}  // namespace ballbar
