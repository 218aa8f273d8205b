// The uncertainty of the parameters of a fit: state, sigma, covariance, and remarks.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "ballbar/fit/fit.hpp"
#include "fit/series_cost.hpp"

namespace ballbar {

// From the weighted Jacobian J at the minimum: covariance = variance (J'J)^-1, sigma from its diagonal; NaN if the
// variance is NaN. A parameter that takes part in a direction without information is undetermined. The sigma of an
// onset is at least that of a uniform distribution over one row.
void add_uncertainty(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds, double variance);

// The same for least squares with `weights` (one per row), for noise with the covariance C:
//   (J'J)^-1 J' W C W J (J'J)^-1
void add_uncertainty_under_noise(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds,
                                 const Eigen::VectorXd& weights);

// Remarks on parameters that are undetermined or on a bound, and on too many parameters for the number of values.
void add_remarks(Fit& result, std::size_t free);

// Smallest number of values beyond the free parameters for an estimate of the variance (with 1, half of the estimates
// would be below 0.45 of the true value).
constexpr std::size_t kFewestLeft = 2;

}  // namespace ballbar
