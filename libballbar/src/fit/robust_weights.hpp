// Tukey's biweight for the residuals of a series, and the variance of what it estimates.
//
//   weight = (1 - u^2)^2 for |u| < 1, else 0;   u = r / (4.685 s),   s = 1.4826 median |r|
//
// 95 % as efficient as least squares at normal noise.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace ballbar {

// Square roots of the weights.
Eigen::VectorXd tukey(const Eigen::VectorXd& residual);

// Rows of less than a tenth of full weight, rising: |r| > 3.87 s.
std::vector<std::size_t> discounted_by(const Eigen::VectorXd& root_of_weight);

// Variance of an M-estimate for (J'J)^-1 without its weights, of independent residuals:
//   n^2 / (n - p) sum psi^2 / (sum psi')^2,   psi = r weight
// Source: P. J. Huber, Robust Statistics (1981), ch. 7.6.
double robust_variance(const Eigen::VectorXd& residual, std::size_t free);

}  // namespace ballbar
