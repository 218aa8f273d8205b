#include "drift/row_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ballbar {

std::optional<double> row_scatter(std::span<const double> time_s, std::span<const double> value) {
  std::vector<double> square;
  square.reserve(value.size());
  for (std::size_t i = 1; i + 1 < value.size(); ++i) {
    const double w = (time_s[i] - time_s[i - 1]) / (time_s[i + 1] - time_s[i - 1]);
    const double from_line = value[i] - (1.0 - w) * value[i - 1] - w * value[i + 1];
    if (!std::isnan(from_line)) square.push_back(from_line * from_line / (1.0 + w * w + (1.0 - w) * (1.0 - w)));
  }
  if (square.size() + 2 < kRowsForScatter) return std::nullopt;
  const std::size_t kept = square.size() - square.size() / 20;
  // A normal variable cut at its 95 % (|z| < 1.960) keeps 0.759 of its variance; fewer than 20 are not cut.
  const double share = kept < square.size() ? 0.7589 : 1.0;
  std::nth_element(square.begin(), square.begin() + static_cast<std::ptrdiff_t>(kept - 1), square.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) sum += square[i];
  return std::sqrt(sum / static_cast<double>(kept) / share);
}

}  // namespace ballbar
