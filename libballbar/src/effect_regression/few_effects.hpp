// A regression of few effects: nine forward selections, each as far as P(none) says, and the mean of what they predict.
#pragma once

#include "effect_regression/ridge.hpp"

namespace ballbar {

// As ridge_fit, over the predictors that any of the nine has chosen, at most 12 each: l = 1800, 7200 and 30 000 s, v =
// 1, 3 and 10; three with l = 0 where that is likelier. Its covariance is that of the mixture: the mean of theirs and
// how far their gains are apart. Memory and sigma are those of the likeliest.
RidgeFit few_effects(const RidgeProblem& problem);

}  // namespace ballbar
