#include "ballbar/internal/fit/parameter_correlation.hpp"

#include <cmath>

namespace ballbar {

Eigen::MatrixXd correlation_of(const Fit& fit) {
  Eigen::MatrixXd correlation = fit.covariance;
  for (Eigen::Index i = 0; i < correlation.rows(); ++i) {
    for (Eigen::Index j = 0; j < correlation.cols(); ++j) {
      correlation(i, j) = fit.covariance(i, j) / std::sqrt(fit.covariance(i, i) * fit.covariance(j, j));
    }
  }
  return correlation;
}

std::optional<Correlation> strongest_correlation(const Fit& fit, std::size_t k) {
  const Eigen::MatrixXd correlation = correlation_of(fit);
  std::optional<Correlation> strongest;
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    const double value = correlation(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
    if (j == k || !std::isfinite(value)) continue;
    if (!strongest || std::abs(value) > std::abs(strongest->value)) strongest = Correlation{j, value};
  }
  return strongest;
}

}  // namespace ballbar
