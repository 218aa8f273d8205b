// The linear model with a set of effects at its most likely parameters, solved at the covariance of the set.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/evidence/linear_model.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct SetRegression {
  LinearModel model;                       // the columns of the members last
  RowMajorMatrix white;                    // of model.columns
  Gram gram;                               // of white
  std::vector<Eigen::Index> first, width;  // of each member: its coefficients
  LinearSolution solution;
  Eigen::Index size() const { return white.cols() - 1; }  // coefficients
};

SetRegression set_regression(const Whitening& whitening, LinearModel model, std::vector<Eigen::Index> widths,
                             const KnownScatter& known);
SetRegression set_regression(const Problem& problem, const Posterior& posterior, const EffectSet& set);

}  // namespace ballbar
