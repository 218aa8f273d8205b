// When a spindle is at rest.
#pragma once

#include <cmath>
#include <span>

namespace ballbar {

// Size of the largest value; a gap does not count.
inline double largest_of(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::fmax(largest, std::abs(value));
  return largest;
}

// Below 2 % of the largest speed, the tolerance of speed_steps.hpp.
inline bool at_standstill(double speed_rpm, double largest_rpm) { return std::abs(speed_rpm) <= 0.02 * largest_rpm; }

}  // namespace ballbar
