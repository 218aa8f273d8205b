// The model about some parameters, as a line: what a set of effects is added to.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

struct Variant {
  std::size_t own = 0;  // 0: the model as it is; else OwnParameter own - 1 is free
  std::vector<double> parameters;
  Eigen::MatrixXd times;  // n by the columns of Kind::time
  RowMajorMatrix pool;    // n by 1 + columns of the line: y first
  Line line;
};

// times: those about the parameters themselves where nothing else is given.
Variant variant_at(const Problem& problem, std::size_t own, std::vector<double> parameters);
Variant variant_at(const Problem& problem, std::size_t own, std::vector<double> parameters, Eigen::MatrixXd times);

// The place of the parameter that is free though the model holds it, as BaseModel::at wants it; none for own = 0.
std::vector<std::size_t> free_of(const Problem& problem, std::size_t own);

// These signatures as columns of the line, their gains free, flat.
Variant with_signatures(const Problem& problem, Variant variant, const std::vector<std::size_t>& signatures);

}  // namespace ballbar
