// Columns that are read in steps too large to tell them from the cause that is found.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/set_regression.hpp"

namespace ballbar {

// The smooth inputs that no member of the set reads and that could stand for one of them, or for all: beside the base
// model and the other members, what a gain g of the readings leaves of their curve is at most 1.5 g q / sqrt(12), q the
// resolution of the input. So it may with a slow drift without a cause: slow_um, its curve. data: as it was read.
std::vector<CoarseColumn> coarse_columns(const Problem& problem, const Series& data, const SetRegression& at,
                                         const Eigen::VectorXd& slow_um, const std::vector<Candidate>& members);

}  // namespace ballbar
