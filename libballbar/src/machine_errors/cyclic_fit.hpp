// The cyclic errors of both axes, on what the errors that are fitted together leave.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "machine_errors/error_blocks.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// Some effects with their columns, those of all in one; FittedEffect::columns are places in it.
struct Part {
  ErrorColumns columns;
  std::vector<FittedEffect> effects;
};

Part part_of(const std::vector<std::pair<FittedEffect, ErrorColumns>>& own, const ErrorRows& rows);

struct CyclicPart {
  Part part;
  Block block;  // all of them at once, each read on its own rows: the inverse is not symmetric
};

// left: of the data after the first fit, a block of columns `together`.
CyclicPart cyclic_part(const std::vector<const Effect*>& effects, const ErrorRows& rows, const ErrorSetUp& set_up,
                       const Eigen::MatrixXd& together, const Block& first, const Eigen::VectorXd& left);

// The inverse of its block after another first fit: what that takes of the cyclic errors is in the equations.
Eigen::MatrixXd cyclic_inverse(const CyclicPart& cyclic, const Eigen::MatrixXd& together, const Block& first);

}  // namespace ballbar
