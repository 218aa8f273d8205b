// The model's parameters where a set of effects beside it makes the readings likeliest.
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
  Eigen::VectorXd coefficients;         // of the columns of Problem::signatures
};

// Gauss-Newton from where the variant has them.
ConditionalFit conditional_fit(const Problem& problem, const Variant& variant,
                               const std::vector<std::size_t>& signatures, const Point& point);

// What a strong effect leaves where the truth lies between two points of the grid another effect would fill in: the
// shapes of the set at their likeliest become signatures of the library, and of the set in the place of the old ones.
ConditionalFit sharpened(Problem& problem, const Variant& variant, ConditionalFit conditional, const Point& point);

// Its parameters, all times that it is free in put here.
std::vector<double> with_times(const Problem& problem, std::vector<double> parameters, double time_s);

// What is not known of the times of the inputs of the model and of the set: columns of Kind::time.
Eigen::MatrixXd input_times_of(const Problem& problem, const ConditionalFit& conditional);

// Whether a shape of the model is no longer where the variant has it, by this share of its reach.
bool is_elsewhere(const Problem& problem, const Variant& variant, const std::vector<double>& parameters, double reach);

}  // namespace ballbar
