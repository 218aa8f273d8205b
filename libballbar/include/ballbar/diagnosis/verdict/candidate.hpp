// One effect with its probability and its tests, beside the model and whatever else is added to it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/bound_effect.hpp"

namespace ballbar {

// 95 % of what the posterior says of a number.
struct Interval {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

// Beside the rest of the set that it is most probable in. NaN: not known.
struct Candidate {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  BoundEffect bound;
  std::string label;  // of the effect, or of the term that it is in a model
  double p = 0.0;     // that it is missing, by the posterior over all sets of effects
  // 2 ln of how much more likely the readings are with it than without, gains, shapes and noise integrated out; from
  // `threshold` on it counts by itself.
  double likelihood_ratio = 0.0;
  double threshold = kLeastLikelihoodRatio;
  std::vector<FittedParameter> parameters;                   // of this effect
  std::vector<Interval> intervals;                           // of each parameter
  double amplitude_um = 0.0;                                 // largest less smallest of what it adds
  double amplitude_sigma_um = kUnknown;                      // infinite: not determined
  double rmse_after_um = kUnknown;                           // of the model with it alone, as `add` fits it
  double held_out_before_um = 0.0, held_out_after_um = 0.0;  // cycles left out, see diagnosis.hpp
  double held_out_evidence = kUnknown;    // ln of the likelihood of cycles left out, gained; without the best cycle
  double p_same_gain = 1.0;               // of gains as different from cycle to cycle
  double gain = 0.0;                      // fall of chi^2
  double best_surrogate_gain = kUnknown;  // largest fall of chi^2 by a surrogate
  double best_surrogate_fall = kUnknown;  // of the RMSE, relative
  std::optional<bool> beats_surrogates;   // nothing: not tested, see diagnosis.hpp
  std::vector<std::string> doubts;        // why it is not named, phrases: "its gain differs from cycle to cycle"
  bool in_best_set = false;
  bool minor = false;                         // below max(5 % of the RMSE, the tolerance)
  std::vector<std::string> inseparable_from;  // labels
};

}  // namespace ballbar
