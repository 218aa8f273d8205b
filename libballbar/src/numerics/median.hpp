#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ballbar {

// The middle value, of an even number the upper of the two; 1.4826 times that of |x - median| is the standard deviation
// of normal numbers. At least one value, none of them NaN.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
inline constexpr double kSigmaOfDeviation = 1.4826;

}  // namespace ballbar
