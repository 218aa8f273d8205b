// Predictors chosen one by one, the gains of all of them together.
//
//   y = a + sum_j b_j x_j + e,   b_j ~ N(0, s^2 v),   e ~ N(0, s^2 N),   a free      (N: ridge.hpp)
//
// A predictor j that joins raises the restricted likelihood by
//
//   -(n-1)/2 ln(1 - v q_j^2 / ((1 + v d_j) S)) - 1/2 ln(1 + v d_j),   q_j = z_j'P r,  d_j = z_j'P z_j,  S = r'P r
//
// z_j and r whitened and freed of a, P = I - sum w w' v / (1 + v g) over those that have joined (w = P z, g = z'w). The
// predictor with the largest rise joins, until no more is needed:
//
//   P(none) = 1 / (1 + mean over the predictors of exp of that rise) > 0.5
#pragma once

#include "predict/ridge.hpp"

namespace ballbar {

// A regression on few effects: the mean of nine such selections. As ridge_fit, over the predictors that any of the nine
// has chosen, at most 12 each: l = 1800, 7200 and 30 000 s, v = 1, 3 and 10; three with l = 0 where that is likelier.
// Its covariance is that of the mixture: the mean of theirs and how far their gains are apart. Memory and sigma are
// those of the likeliest.
RidgeFit few_effects(const RidgeProblem& problem);

}  // namespace ballbar
