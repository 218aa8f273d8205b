// Start values that depend on the rows: for periodic effects, and for shares of the range of a signal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

inline double range_in(std::span<const double> values) {
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

inline double rise_in(std::span<const double> values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end()) - values[0];
}

// Wave numbers (waves per unit) from lowest to highest, in steps of half a wave over the span, at most `most`.
inline std::vector<double> wave_numbers(double lowest, double highest, double span, std::size_t most) {
  std::vector<double> result;
  if (!(span > 0.0) || !(highest > lowest)) return result;
  const double step = std::max(0.5 / span, (highest - lowest) / static_cast<double>(most));
  for (double f = lowest; f <= highest && result.size() < most; f += step) result.push_back(f);
  return result;
}

// Lengths of such waves, falling.
inline std::vector<double> wave_lengths(double shortest, double longest, double span, std::size_t most) {
  std::vector<double> result = wave_numbers(1.0 / longest, 1.0 / shortest, span, most);
  for (double& value : result) value = 1.0 / value;
  return result;
}

template <class Shares>
std::vector<double> shares_of(double whole, const Shares& shares) {
  std::vector<double> result;
  for (const double share : shares) result.push_back(share * whole);
  return result;
}

}  // namespace ballbar
