// The part of a curve that the free parameters of a fitted model can absorb, to first order.
#pragma once

#include <vector>

#include "ballbar/fit/fit.hpp"

namespace ballbar {

// Projects each curve y (n values in um, on the rows of the fit) onto the columns J of the free parameters in the fit's
// Jacobian: J (J'J)^-1 J' y, unweighted. The columns are scaled to length 1, because their units differ; equal columns
// count once. Returns zeros where no parameter is free. Cost: O(n p^2) once and O(n p) per curve.
std::vector<std::vector<double>> model_parts_um(const Fit& fit, const std::vector<std::vector<double>>& curves_um);

}  // namespace ballbar
