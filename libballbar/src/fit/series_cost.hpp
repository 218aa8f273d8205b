// The cost function of all models of a series: target minus model, weighted or whitened, in one Ceres problem.
//
// n rows enter through the Gram matrix of [J r] alone, as in least_squares.hpp: Ceres gets its triangular factor
// [U q; 0 e], P + 1 residuals, and takes the steps that all n would give. The rows are made, whitened and summed block
// by block, in buffers that are used again.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/model_rows.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

// The weighting of residuals: a weight per row, then the filter of the noise, then the weights of a robust fit.
struct Weighting {
  Eigen::VectorXd row;  // n; 1 / sigma, or 1 if the filter includes sigma
  std::optional<Whitening> whitening = {};
  Eigen::VectorXd discount = {};  // n square roots of robust weights; empty: none
};

Eigen::VectorXd weighted(const Weighting& weighting, const Eigen::VectorXd& residual);
Eigen::MatrixXd weighted(const Weighting& weighting, const Eigen::MatrixXd& jacobian);

struct Bounds {
  Eigen::VectorXd lower, upper;  // of all parameters
  std::vector<bool> held;
};

struct Minimum {
  Eigen::VectorXd parameters;
  double cost = 0.0;  // half the sum of squares; infinite: the model is not finite
  bool converged = false;
};

// A positive parameter with bounds more than a factor of 100 apart is fitted by its logarithm.
Minimum minimise(const ModelRows& rows, const Eigen::VectorXd& target_um, const Weighting& weighting,
                 const Bounds& bounds, const Eigen::VectorXd& start, int most_iterations = 100);

}  // namespace ballbar
