// The model linearised about some parameters, to which a set of effects is added.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

struct Variant {
  std::size_t own = 0;  // 0: the unchanged model; else OwnParameter own - 1 is free
  std::vector<double> parameters;
  Eigen::MatrixXd times;  // n by the open columns: times of inputs, levels of the target
  RowMajorMatrix pool;    // n by 1 + columns of the linear model, y first
  Line line;
};

// times: by default those at the parameters.
Variant variant_at(const Problem& problem, std::size_t own, std::vector<double> parameters);
Variant variant_at(const Problem& problem, std::size_t own, std::vector<double> parameters, Eigen::MatrixXd times);

// The index of the held parameter that is set free, for BaseModel::at(); none for own = 0.
std::vector<std::size_t> free_of(const Problem& problem, std::size_t own);

// Each input in any form as open columns of the linear model, in place of all effects.
Variant beside_any_forms(const Problem& problem, Variant variant);

// These signatures as columns of the linear model, with flat priors of their gains.
Variant with_signatures(const Problem& problem, Variant variant, const std::vector<std::size_t>& signatures);

}  // namespace ballbar
