#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace ballbar {

// ln of the sum of e^x.
inline double log_sum(std::span<const double> logarithms) {
  double most = -std::numeric_limits<double>::infinity();
  for (const double one : logarithms) most = std::max(most, one);
  if (!std::isfinite(most)) return most;
  double sum = 0.0;
  for (const double one : logarithms) sum += std::exp(one - most);
  return most + std::log(sum);
}

}  // namespace ballbar
