// The columns that a fit was free in: the model as a straight line about its solution.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// Parameters that the fit was free in, by their place.
std::vector<Eigen::Index> used_parameters(const Fit& fit);

// Their columns of the Jacobian, scaled to unit length.
Eigen::MatrixXd model_columns(const Fit& fit);

// The model's columns made orthonormal and what they leave of the residual; as they are, or both whitened.
struct Freed {
  Eigen::MatrixXd basis;     // n by the rank of the model
  Eigen::VectorXd residual;  // n
};

}  // namespace ballbar
