// Pauses of a log after which a machine has forgotten its temperatures.
#pragma once

#include <algorithm>
#include <vector>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

inline constexpr double kRest_s = 8.0 * 3600.0;  // a machine that stood less than that begins warm
inline constexpr double kRestSteps = 10.0;       // a shorter pause is a step of the log

// The rows between such pauses, or shorter ones, of rising times.
inline std::vector<RowRange> between_pauses(const std::vector<double>& time_s, double rest_s = kRest_s) {
  const double longest_s = std::max(rest_s, kRestSteps * median_step_s(time_s));
  std::vector<RowRange> parts;
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    if (row == 0 || time_s[row] - time_s[row - 1] >= longest_s) parts.push_back({row, row});
    parts.back().end = row + 1;
  }
  return parts;
}

}  // namespace ballbar
