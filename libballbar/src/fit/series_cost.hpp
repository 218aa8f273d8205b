// The cost function of all models of a series: target minus model, weighted or whitened, in one Ceres problem.
//
// n rows enter through the Gram matrix of [J r] alone, as in least_squares.hpp: Ceres gets its triangular factor
// [U q; 0 e], P + 1 residuals, and takes the steps that all n would give. The rows are made, whitened and summed block
// by block, in buffers that are used again.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/model_rows.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

// Columns E u of a target y = model + E u + scatter, u ~ N(0, 1) um, that are integrated out.
struct OpenColumns {
  OpenColumns() = default;  // none
  // columns: n by q, white. variance: of the scatter that remains, in units of the filter's covariance.
  OpenColumns(RowMajorMatrix columns, double variance);

  RowMajorMatrix white;                // n by q
  Eigen::LLT<Eigen::MatrixXd> factor;  // of E'E + variance
};

// The weighting of residuals: a weight per row, then the filter of the noise, then the weights of a robust fit.
struct Weighting {
  Eigen::VectorXd row;  // n; 1 / sigma, or 1 if the filter includes sigma
  std::optional<Whitening> whitening = {};
  Eigen::VectorXd discount = {};  // n square roots of robust weights; empty: none
  OpenColumns open = {};
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

struct Stop {
  int most_iterations = 100;
  double tolerance = 1e-10;  // relative, of the cost and of the parameters
};

// A positive parameter with bounds more than a factor of 100 apart is fitted by its logarithm.
Minimum minimise(const ModelRows& rows, const Eigen::VectorXd& target_um, const Weighting& weighting,
                 const Bounds& bounds, const Eigen::VectorXd& start, Stop stop = {});

}  // namespace ballbar
