#include "numerics/tukey.hpp"

#include <algorithm>

namespace ballbar {
namespace {

constexpr double kLeastSigma = 1e-12;  // where most of the residual is 0

}  // namespace

Eigen::ArrayXd tukey(const Eigen::ArrayXd& residual, double sigma) {
  const Eigen::ArrayXd u = residual / (kTukey * std::max(sigma, kLeastSigma));
  return (1.0 - u.square()).max(0.0);
}

std::vector<std::size_t> discounted_by(const Eigen::ArrayXd& root_of_weight) {
  std::vector<std::size_t> rows;
  for (Eigen::Index i = 0; i < root_of_weight.size(); ++i) {
    if (root_of_weight[i] * root_of_weight[i] < 0.1) rows.push_back(static_cast<std::size_t>(i));
  }
  return rows;
}

double robust_variance(const Eigen::ArrayXd& residual, double sigma, double spent) {
  const Eigen::ArrayXd root = tukey(residual, sigma);
  const double psi2 = (residual * root.square()).square().sum();
  const double slope = (root * (5.0 * root - 4.0)).sum();  // 1 - 5 u^2 = 5 (1 - u^2) - 4
  const auto n = static_cast<double>(residual.size());
  return n * n / std::max(1.0, n - spent) * psi2 / (slope * slope);
}

}  // namespace ballbar
