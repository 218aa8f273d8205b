#include "drift/slope_of_rows.hpp"

#include <algorithm>
#include <cstddef>

namespace ballbar {
namespace {

constexpr std::size_t kFewestRows = 5;
constexpr std::size_t kMostEachWay = 50;
constexpr double kLeft = 0.1;
constexpr double kSurelyScatter = 3.0;

}  // namespace

std::optional<Slopes> slopes_of_rows(std::span<const double> time_s, std::span<const double> value,
                                     std::span<const double> variance) {
  const std::size_t n = time_s.size();
  if (n < kFewestRows) return std::nullopt;
  const std::size_t each_way = std::clamp<std::size_t>(n / 60, 1, kMostEachWay);
  const std::size_t width = 2 * each_way + 1;
  Slopes slopes;
  slopes.per_s.reserve(n);
  slopes.variance.reserve(n);
  for (std::size_t row = 0; row < n; ++row) {
    // As many rows at the ends.
    const std::size_t first = std::min(row > each_way ? row - each_way : 0, n - width);
    const double unit_s = time_s[first + width - 1] - time_s[first];
    double u1 = 0.0, u2 = 0.0, u3 = 0.0, u4 = 0.0;
    for (std::size_t k = first; k < first + width; ++k) {
      const double u = (time_s[k] - time_s[row]) / unit_s, uu = u * u;
      u1 += u;
      u2 += uu;
      u3 += uu * u;
      u4 += uu * uu;
    }
    // Second row of the inverse of the normal equations.
    const auto u0 = static_cast<double>(width);
    const double determinant = u0 * (u2 * u4 - u3 * u3) - u1 * (u1 * u4 - u2 * u3) + u2 * (u1 * u3 - u2 * u2);
    const double c0 = (u2 * u3 - u1 * u4) / determinant, c1 = (u0 * u4 - u2 * u2) / determinant,
                 c2 = (u1 * u2 - u0 * u3) / determinant;
    double slope = 0.0, scatter = 0.0;
    for (std::size_t k = first; k < first + width; ++k) {
      const double u = (time_s[k] - time_s[row]) / unit_s;
      const double weight = (c0 + c1 * u + c2 * u * u) / unit_s;
      slope += weight * value[k];
      scatter += weight * weight * variance[k];
    }
    slopes.per_s.push_back(slope);
    slopes.variance.push_back(scatter);
  }
  double steps = 0.0, left = 0.0, scatter = 0.0;
  for (std::size_t row = 1; row < n; ++row) {
    const double step = value[row] - value[row - 1];
    const double rest = step - 0.5 * (slopes.per_s[row] + slopes.per_s[row - 1]) * (time_s[row] - time_s[row - 1]);
    steps += step * step;
    left += rest * rest;
    scatter += variance[row] + variance[row - 1];
  }
  if (left > kLeft * steps + kSurelyScatter * scatter) return std::nullopt;
  return slopes;
}

}  // namespace ballbar
