// A fitted series without the rows that a robust fit discounted.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// `discounted`: rising indices of rows; `values` may be empty.
std::vector<double> without(const std::vector<double>& values, const std::vector<std::size_t>& discounted);
Eigen::MatrixXd without(const Eigen::MatrixXd& rows, const std::vector<std::size_t>& discounted);

// Rows, times, residuals and sigmas without the discounted rows, with noise, floor and RMSE of the fit. The other
// members stay empty.
Fit inliers_of(const Fit& fit);

}  // namespace ballbar
