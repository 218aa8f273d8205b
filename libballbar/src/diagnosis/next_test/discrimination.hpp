// How far one signal is from a space of columns, over several runs.
//
// X = columns of all candidates over the rows of one run, W the whitening of its noise. W X is kept by its triangular
// factor R (R' R = X' W' W X), which has all that is needed, in as many rows as X has columns; runs whose noise does
// not remember each other are put on top of each other. For signal a and columns B among those of X,
//
//   d = |(I - P_B) R a|
//
// is the root of the fall of chi^2 when a is true and B is fitted instead.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ballbar/noise/noise.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

// n by m columns -> at most m rows.
Eigen::MatrixXd whitened_factor(const Eigen::MatrixXd& columns, const Whitening& whitening);

// Of the run with the factor `first` and another together; same columns.
Eigen::MatrixXd both(const Eigen::MatrixXd& first, const Eigen::MatrixXd& columns, const Whitening& whitening);

double distance(const Eigen::MatrixXd& factor, Eigen::Index signal, const std::vector<Eigen::Index>& columns);

}  // namespace ballbar
