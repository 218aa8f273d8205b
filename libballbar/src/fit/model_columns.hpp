// The columns of the free parameters of a fit: the model linearised at its solution.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// Indices of the free parameters of the fit.
std::vector<Eigen::Index> used_parameters(const Fit& fit);

// Their columns of the Jacobian, scaled to unit length.
Eigen::MatrixXd model_columns(const Fit& fit);

}  // namespace ballbar
