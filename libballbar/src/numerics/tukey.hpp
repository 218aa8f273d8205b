// Tukey's biweight of residuals, and the variance of what it estimates.
//
//   weight = (1 - u^2)^2 for |u| < 1, else 0;   u = r / (4.685 s)
//
// s is the standard deviation of the residual, such as median_sigma. 95 % as efficient as least squares at normal
// noise.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace ballbar {

inline constexpr double kTukey = 4.685;

// Square roots of the weights.
Eigen::ArrayXd tukey(const Eigen::ArrayXd& residual, double sigma);

// Rows of less than a tenth of full weight, rising: |r| > 3.87 s.
std::vector<std::size_t> discounted_by(const Eigen::ArrayXd& root_of_weight);

// Variance of an M-estimate for (J'J)^-1 without its weights, of independent residuals, p of which are spent:
//   n^2 / (n - p) sum psi^2 / (sum psi')^2,   psi = r weight;   n - p at least 1
// Source: P. J. Huber, Robust Statistics (1981), ch. 7.6.
double robust_variance(const Eigen::ArrayXd& residual, double sigma, double spent);

}  // namespace ballbar
