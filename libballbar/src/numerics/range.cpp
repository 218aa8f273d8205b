#include "ballbar/internal/numerics/range.hpp"

#include <algorithm>

namespace ballbar {

double range_of(std::span<const double> values) {
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

}  // namespace ballbar
