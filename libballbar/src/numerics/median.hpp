// Scatter by the median of its sizes, whatever the outliers.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {

// Standard deviation of normal numbers over the median of |x - median|.
inline constexpr double kSigmaOfDeviation = 1.4826;

// 1.4826 median |r|, of a vector about 0. At least one number, none of them NaN.
template <class Vector>
double median_sigma(const Vector& residual) {
  std::vector<double> size;
  size.reserve(static_cast<std::size_t>(residual.size()));
  for (const double r : residual) size.push_back(std::abs(r));
  return kSigmaOfDeviation * median(std::move(size));
}

}  // namespace ballbar
