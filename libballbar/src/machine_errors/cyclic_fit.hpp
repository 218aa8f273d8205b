// Fits the cyclic errors of both axes to the residual of the jointly fitted errors.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "machine_errors/error_blocks.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// Effects with their columns in one matrix; FittedEffect::columns are indices into it.
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
  Eigen::MatrixXd undetermined;      // shares of the columns in combinations that are held at 0; one a column
};

// left: of the data after the first fit, a block of columns `together`.
CyclicPart cyclic_part(const std::vector<const Effect*>& effects, const ErrorRows& rows, const ErrorSetUp& set_up,
                       const Eigen::MatrixXd& together, const Block& first, const Eigen::VectorXd& left);

// The same after another first fit.
void with_first(CyclicPart& cyclic, const Block& first);

// The inverse of its block where the first fit, of the same weights, has this inverse: what that takes of the cyclic
// errors is in the equations. Each row of these is read where its own axis shows, so that they are not symmetric, and a
// pitch of a quarter of the travel, or any on a short arc, makes some combination of both axes' waves with the circle
// and the straightness nearly singular, whatever least squares of all rows would say. Such a combination is held at 0,
// by a truncated singular value decomposition (P. C. Hansen, BIT 27 (1987)), of unit curves scaled to one size.
struct CyclicInverse {
  Eigen::MatrixXd inverse, undetermined;
};
CyclicInverse cyclic_inverse(const CyclicPart& cyclic, const Eigen::MatrixXd& of_first);

}  // namespace ballbar
