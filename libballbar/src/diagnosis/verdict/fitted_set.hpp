// A set of effects fitted together with the model, with free shapes, at its most likely parameters.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/model/model.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct FittedSet {
  Model model;                                           // with the effects after its terms, and their shapes as starts
  std::vector<FittedParameter> parameters;               // as Fit::parameters
  std::vector<Interval> intervals;                       // 95 %
  std::vector<double> amplitude_um, amplitude_sigma_um;  // per effect
  double together_um = 0.0;                              // amplitude of the sum of the effects
};

// Fits at the most likely covariance and parameters of the set. Throws Error as fit() does. with_profiles: intervals of
// the added effects from the profile likelihood, else from its curvature.
FittedSet fitted_set(const Problem& problem, const Posterior& posterior, const EffectSet& set, bool with_profiles);

}  // namespace ballbar
