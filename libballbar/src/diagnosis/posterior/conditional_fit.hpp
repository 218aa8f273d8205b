// The most likely parameters of the model with a given set of effects.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

struct ConditionalFit {
  std::vector<std::size_t> signatures;  // the set
  std::vector<double> parameters;       // of the model, in their own units
  Eigen::VectorXd coefficients = {};    // of the columns of Problem::signatures
  double square = 0.0;                  // residual sum of squares of the white readings
};

// From the parameters of the variant, the shapes of the set held.
ConditionalFit conditional_fit(const Problem& problem, const Variant& variant,
                               const std::vector<std::size_t>& signatures, const Point& point);

// Adds the most likely shapes of the set to the library, and replaces the signatures of the set by them. Without this,
// another effect would explain the residual of a strong effect whose true shape lies between two points of the grid.
ConditionalFit sharpened(Problem& problem, const Variant& variant, ConditionalFit conditional, const Point& point);

}  // namespace ballbar
