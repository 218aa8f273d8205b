// A set of effects fitted beside the model, shapes free, where it is most likely.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/candidate.hpp"
#include "ballbar/model/model.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct FittedSet {
  Model model;                                           // with the effects behind its terms, their shapes begun here
  std::vector<FittedParameter> parameters;               // as Fit::parameters
  std::vector<Interval> intervals;                       // 95 %
  std::vector<double> amplitude_um, amplitude_sigma_um;  // of each effect
  double together_um = 0.0;                              // as amplitude_um, of the sum of the effects
  double rmse_um = 0.0;
};

// At the covariance and about the parameters where the set is most likely. Throws Error as fit does.
// with_profiles: intervals of the added effects by the profile of the likelihood, else by its curvature.
FittedSet fitted_set(const Problem& problem, const Posterior& posterior, const EffectSet& set, bool with_profiles);

}  // namespace ballbar
