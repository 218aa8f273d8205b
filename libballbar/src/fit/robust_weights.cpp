#include "fit/robust_weights.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar {
namespace {

constexpr double kTukey = 4.685;
constexpr double kLeastScale = 1e-12;

double scale_of(const Eigen::VectorXd& residual) {
  Eigen::VectorXd size = residual.cwiseAbs();
  double* const middle = size.data() + size.size() / 2;
  std::nth_element(size.data(), middle, size.data() + size.size());
  return std::max(1.4826 * *middle, kLeastScale);
}

}  // namespace

Eigen::VectorXd tukey(const Eigen::VectorXd& residual) {
  const Eigen::ArrayXd u = residual.array() / (kTukey * scale_of(residual));
  return (1.0 - u.square()).max(0.0);
}

std::vector<std::size_t> discounted_by(const Eigen::VectorXd& root_of_weight) {
  std::vector<std::size_t> rows;
  for (Eigen::Index i = 0; i < root_of_weight.size(); ++i) {
    if (root_of_weight[i] * root_of_weight[i] < 0.1) rows.push_back(static_cast<std::size_t>(i));
  }
  return rows;
}

double robust_variance(const Eigen::VectorXd& residual, std::size_t free) {
  const double scale = scale_of(residual);
  double psi2 = 0.0, slope = 0.0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    const double u2 = std::pow(residual[i] / (kTukey * scale), 2);
    if (u2 >= 1.0) continue;
    psi2 += std::pow(residual[i] * (1.0 - u2) * (1.0 - u2), 2);
    slope += (1.0 - u2) * (1.0 - 5.0 * u2);
  }
  const auto n = static_cast<double>(residual.size());
  return n * n / std::max(1.0, n - static_cast<double>(free)) * psi2 / (slope * slope);
}

}  // namespace ballbar
