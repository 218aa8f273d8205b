// DriverReport of a regression as it was trained.
#pragma once

#include "ballbar/predict/train.hpp"
#include "predict/ridge.hpp"

namespace ballbar {

// refit: whether shares without cycles and what is not needed are looked at. first_run: whose cycles of speed are left
// out where it is the only one.
DriverReport driver_report(const Design& design, const Series& first_run, const RidgeProblem& problem,
                           const RidgeFit& fit, bool refit);

// range(sum) cov(column, sum) / var(sum) of each column, n by drivers: shares of its range where they add up to it.
Eigen::VectorXd shares_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& sum);

}  // namespace ballbar
