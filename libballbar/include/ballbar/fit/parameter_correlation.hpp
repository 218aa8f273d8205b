// How the parameters of a fit vary together.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// covariance_ij / sqrt(covariance_ii covariance_jj), 1 on the diagonal; NaN in the row and the column of a parameter
// that has no variance, because it is held.
Eigen::MatrixXd correlation_of(const Fit& fit);

// The other parameter whose correlation with the k-th is largest in size; nothing where no other one is known.
struct Correlation {
  std::size_t with = 0;  // of the fit's parameters
  double value = 0.0;    // -1 to 1
};
std::optional<Correlation> strongest_correlation(const Fit& fit, std::size_t k);

}  // namespace ballbar
