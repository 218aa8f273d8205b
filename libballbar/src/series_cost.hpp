// The one cost of all models of a series: target less model, weighted or whitened, in one Ceres problem.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "ballbar/noise.hpp"
#include "model_rows.hpp"

namespace ballbar {

// How residuals are made comparable: a weight a row, then the filter of the noise where there is one.
struct Weighting {
  Eigen::VectorXd row;                 // n; 1 over sigma, or what a robust fit leaves of it
  std::optional<Whitening> whitening;  // then `row` holds the robust weights alone
};

Eigen::VectorXd weighted(const Weighting& weighting, const Eigen::VectorXd& residual);
Eigen::MatrixXd weighted(const Weighting& weighting, const Eigen::MatrixXd& jacobian);

struct Bounds {
  Eigen::VectorXd lower, upper;  // of all parameters
  std::vector<bool> held;
};

struct Minimum {
  Eigen::VectorXd parameters;
  double cost = 0.0;  // half the sum of squares; infinite: the model has no finite values there
  bool converged = false;
};

// A positive parameter whose bounds are more than a factor of 100 apart moves by its logarithm.
Minimum minimise(const ModelRows& rows, const Eigen::VectorXd& target_um, const Weighting& weighting,
                 const Bounds& bounds, const Eigen::VectorXd& start, int most_iterations = 100);

}  // namespace ballbar
