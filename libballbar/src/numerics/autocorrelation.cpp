#include "numerics/autocorrelation.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar::least_squares {

Autocorrelation autocorrelation_of(const Eigen::ArrayXd& residual) {
  constexpr Eigen::Index kLags = 8;
  const Eigen::Index n = residual.size();
  if (n < 4 * kLags) return {};
  const double variance = residual.square().sum();
  if (!(variance > 0.0)) return {};
  Eigen::Array<double, kLags, 1> r = Eigen::Array<double, kLags, 1>::Zero();
  for (Eigen::Index i = 0; i + kLags < n; ++i) r += residual[i] * residual.segment<kLags>(i + 1);
  r /= variance;
  if (r[0] < 3.0 / std::sqrt(static_cast<double>(n))) return {};
  const double slope = (r.head<kLags - 1>() * r.tail<kLags - 1>()).sum() / r.head<kLags - 1>().square().sum();
  const double slowest =
      1.0 - 1.0 / static_cast<double>(n);  // slower than the sweep cannot be separated from a constant
  const double phi = std::clamp(slope, std::min(r[0], slowest), slowest);
  return {phi, std::min(1.0, r[0] / phi)};
}

}  // namespace ballbar::least_squares
