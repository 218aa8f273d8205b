// Values by their rank.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace ballbar {

// The value of the given rank, counted from 0 upwards; rank < number of values, no NaN. O(n).
template <class T>
T order_statistic(std::vector<T> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The middle value, of an even number the upper of the two. At least one value, none of them NaN.
template <class T>
T median(std::vector<T> values) {
  const std::size_t middle = values.size() / 2;
  return order_statistic(std::move(values), middle);
}

// Each value less the median of those that are at most so many rows from it. No NaN.
std::vector<double> less_running_median(const std::vector<double>& values, std::size_t rows);

// Median of the positive time steps; 0 if there are none. O(n).
double median_step_s(std::span<const double> time_s);

}  // namespace ballbar
