// Correlation of the parameters of a fit.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// covariance_ij / sqrt(covariance_ii covariance_jj); 1 on the diagonal. A held parameter has no variance: its row and
// column are NaN.
Eigen::MatrixXd correlation_of(const Fit& fit);

// The other parameter with the largest absolute correlation with the k-th; nullopt where no correlation is known.
struct Correlation {
  std::size_t with = 0;  // index into Fit::parameters
  double value = 0.0;    // -1 to 1
};
std::optional<Correlation> strongest_correlation(const Fit& fit, std::size_t k);

}  // namespace ballbar
