// One candidate effect with its probability and the results of its tests.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/bound_effect.hpp"

namespace ballbar {

// A 95 % credible interval of a number; NaN: not known.
struct Interval {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

// Why an effect is not named, or not supported where it was added.
enum class Doubt {
  time_alone,        // it reads no column: any slow drift looks like it
  gain_differs,      // its gain differs between cycles, or recordings
  not_predictive,    // it does not improve the prediction of left-out cycles, or recordings
  weak_evidence,     // its likelihood ratio is below kLeastLikelihoodRatio
  forgotten_change,  // of a jump: one reading, or a change within the memory of the noise, explains nearly as much
  drift_beside,      // a smaller slow drift without a cause is beside it, so that its form is open
  larger_drift,      // a larger slow drift without a cause is beside it
  in_the_model,      // the model can produce what it adds
  not_shown,         // of an error of the axes: these recordings cannot show it
  not_significant,   // of an error of the axes: beside the others it is not significant
};

// Figures are those of the effect in its most probable set, with the other effects of that set. NaN: not known.
struct Candidate {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  BoundEffect bound;
  std::string label;  // of the effect, or of its term if it is part of a model
  double p = 0.0;     // probability that it is missing, from the posterior over all sets of effects
  // 2 ln of the likelihood ratio of the readings with and without it; gains, shapes and noise are integrated out. From
  // `threshold` on the evidence is sufficient by itself.
  double likelihood_ratio = 0.0;
  double threshold = kLeastLikelihoodRatio;
  std::vector<FittedParameter> parameters;  // of this effect
  std::vector<Interval> intervals;          // of each parameter
  double amplitude_um = 0.0;                // range (max - min) of its contribution
  double amplitude_sigma_um = kUnknown;     // infinite: not determined
  double rmse_after_um = kUnknown;          // of the model with this effect alone added
  // RMSE in cycles left out of the fit, of the model with the other members of the set and with this one as well; of a
  // series as LedgerRow::held_out_um.
  double held_out_before_um = 0.0, held_out_after_um = 0.0;
  double held_out_evidence = kUnknown;  // gain in ln likelihood of the left-out cycles, without the best cycle
  double p_same_gain = 1.0;             // p-value of equal gains in all cycles
  std::vector<Doubt> doubts;            // none: it may be named
  // An input in any form is more likely in its place than all effects of the catalogue together.
  bool other_form_likelier = false;
  bool in_best_set = false;
  bool minor = false;                         // below max(5 % of the RMSE, the tolerance)
  std::vector<std::string> inseparable_from;  // labels of other effects
};

}  // namespace ballbar
