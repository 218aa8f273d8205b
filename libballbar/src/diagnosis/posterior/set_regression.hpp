// A set of effects as columns at its most likely parameters, whitened and not, for its tests.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/posterior/posterior.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

// White columns have additional rows, one for each column with the prior N(0, 1).
struct SetRegression {
  Eigen::VectorXd y;                       // n
  Eigen::MatrixXd line;                    // n by p
  Eigen::MatrixXd members;                 // n by all gains of the set
  std::vector<Eigen::Index> first, width;  // of each member
  Eigen::VectorXd white_y;                 // n + r
  Eigen::MatrixXd white_line, white_members;
  double variance = 0.0;  // of the scatter with the set, in units of the covariance
  double degrees = 0.0;

  Eigen::MatrixXd white(const Whitening& filter, const Eigen::MatrixXd& columns) const;  // with additional rows of 0
  Eigen::MatrixXd white_columns() const;                        // of the line, then of all members
  Eigen::MatrixXd white_columns_but(std::size_t member) const;  // without those of one member
  Eigen::MatrixXd columns_but(std::size_t member) const;        // likewise, not whitened
};

SetRegression set_regression(const Problem& problem, const Posterior& posterior, const EffectSet& set);

}  // namespace ballbar
