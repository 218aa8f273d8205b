// A fit as a straight line about its solution: its residual, and the columns that the model was free in.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/noise/noise.hpp"

namespace ballbar {

// Parameters that the fit was free in, by their place.
std::vector<Eigen::Index> used_parameters(const Fit& fit);

// Their columns of the Jacobian, scaled to unit length.
Eigen::MatrixXd model_columns(const Fit& fit);

// Of these columns: infinite for a gain; for a shape what it adds when it doubles.
std::vector<double> model_reach_um(const Fit& fit);

// Where a term's parameters begin in Fit::parameters: the constant comes first.
std::size_t first_parameter(const Model& model, std::size_t term);

// Columns of the Jacobian that are gains of the term.
Eigen::MatrixXd gain_columns(const Fit& fit, const Model& model, std::size_t term);

// What is left of a fit, on which everything that follows is linear.
struct LinearisedFit {
  std::vector<double> time_s, sigma_um;  // sigma_um: stated, or empty
  Eigen::VectorXd residual_um;           // n
  Eigen::MatrixXd model;                 // n by p: columns that the model was free in
  // p: how far a column's factor may go for the model to be linear: of a shape its own size. Empty: any
  std::vector<double> reach_um = {};
};
LinearisedFit linearised_fit_of(const Fit& fit);

// The model's columns made orthonormal and what they leave of the residual; as they are, or both whitened.
struct Freed {
  Eigen::MatrixXd basis;     // n by the rank of the model
  Eigen::VectorXd residual;  // n
};
Freed freed_of(const LinearisedFit& linearised);
Freed freed_of(const LinearisedFit& linearised, const Whitening& whitening);

}  // namespace ballbar
