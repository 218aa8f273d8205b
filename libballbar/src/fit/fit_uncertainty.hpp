// What a fit knows of its parameters: state, sigma, covariance, and the sentences about them.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "ballbar/fit/fit.hpp"
#include "fit/series_cost.hpp"

namespace ballbar {

// From the weighted Jacobian J at the minimum: covariance = variance (J'J)^-1, sigma from its diagonal; NaN where the
// variance is. A parameter with a share of a direction without information is undetermined. An onset is known to the
// row, not better: at least the rms of being anywhere within a row of the truth.
void add_uncertainty(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds, double variance);

// The same for least squares with `weights` (one a row) under the fit's noise, whose covariance is C:
//   (J'J)^-1 J' W C W J (J'J)^-1
void add_uncertainty_under_noise(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds,
                                 const Eigen::VectorXd& weights);

// About parameters that are not determined or on a bound, and more of them than the values can tell.
void add_remarks(Fit& result, std::size_t free);

// A variance is not told by less than this many values more than free parameters (1: half of its estimates would be
// below 0.45 of it).
constexpr std::size_t kFewestLeft = 2;

}  // namespace ballbar
