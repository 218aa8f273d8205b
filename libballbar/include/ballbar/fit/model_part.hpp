// What the free parameters of a fitted model can make of a curve, to first order.
#pragma once

#include <vector>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// Of each curve (n values at the rows of the fit, in um) its part in the space that the columns of the free parameters
// span in the fit's Jacobian: its least squares projection J (J'J)^-1 J' y, unweighted. Columns are scaled to length 1,
// for their units differ; two that are the same count as one. Zeros where nothing is free. n p^2 once, n p a curve.
std::vector<std::vector<double>> model_parts_um(const Fit& fit, const std::vector<std::vector<double>>& curves_um);

}  // namespace ballbar
