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
  Block block;                       // all of them at once, each read on its own rows: the inverse is not symmetric
  Eigen::MatrixXd own, of_together;  // the weighted columns' products with themselves and with the columns together
  Eigen::MatrixXd shared;            // products of the columns together, as the first fit weights them, with these
};

// left: of the data after the first fit, a block of columns `together`.
CyclicPart cyclic_part(const std::vector<const Effect*>& effects, const ErrorRows& rows, const ErrorSetUp& set_up,
                       const Eigen::MatrixXd& together, const Block& first, const Eigen::VectorXd& left);

// After another first fit.
void with_first(CyclicPart& cyclic, const Block& first);

// The inverse of its block where the first fit, of the same weights, has this inverse: what that takes of the cyclic
// errors is in the equations.
Eigen::MatrixXd cyclic_inverse(const CyclicPart& cyclic, const Eigen::MatrixXd& of_first);

}  // namespace ballbar
