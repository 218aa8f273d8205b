// What is left of a fitted series without the rows that a robust fit discounted.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// `discounted` rising, numbers of rows; `values` may be empty.
std::vector<double> without(const std::vector<double>& values, const std::vector<std::size_t>& discounted);
Eigen::MatrixXd without(const Eigen::MatrixXd& rows, const std::vector<std::size_t>& discounted);

// Rows, times, residuals and sigma that count, with the fit's noise, floor and RMSE; the rest of the fit is left out.
Fit inliers_of(const Fit& fit);

}  // namespace ballbar
