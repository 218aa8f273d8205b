// The resolution of a logged column.
#pragma once

#include <cmath>
#include <limits>
#include <span>

namespace ballbar {

// The smallest step between neighbours if all steps are multiples of it; 0: none.
inline double resolution_of(std::span<const double> values) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = std::abs(values[i] - values[i - 1]);
    if (step > 1e-9) least = std::min(least, step);
  }
  if (!std::isfinite(least)) return 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double steps = std::abs(values[i] - values[i - 1]) / least;
    if (std::abs(steps - std::round(steps)) > 0.01) return 0.0;
  }
  return least;
}

}  // namespace ballbar
