// One effect with its tests, beside the model and whatever else is added to it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/bound_effect.hpp"

namespace ballbar {

// Beside the model alone, or, for those of the best set or of an effect test, beside the rest of that. NaN: not known.
struct Candidate {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  BoundEffect bound;
  std::string label;                        // of the effect, or of the term that it is in a model
  std::vector<FittedParameter> parameters;  // of this effect
  double amplitude_um = 0.0;                // largest less smallest of what it adds
  double amplitude_sigma_um = kUnknown;     // infinite: not determined
  double rmse_after_um = 0.0;
  double held_out_before_um = 0.0, held_out_after_um = 0.0;  // cycles left out, see diagnosis.hpp
  double likelihood_ratio = 0.0;                             // 2 ln L gained by it
  double threshold = 0.0;                 // of the likelihood ratio: the search exceeds it by chance in 1 %
  double p_search = 1.0;                  // share of data sets without any effect that show one as rare
  double p_same_gain = 1.0;               // of gains as different from cycle to cycle
  double gain = 0.0;                      // fall of chi^2 by the noise with it
  double best_surrogate_gain = kUnknown;  // largest fall of chi^2 by a surrogate
  double best_surrogate_fall = kUnknown;  // of the RMSE, relative
  std::optional<bool> beats_surrogates;   // nothing: not tested, see diagnosis.hpp
  std::vector<std::string> doubts;        // why it is not a cause, phrases: "its likelihood ratio is below 25 (d = 5)"
  bool in_best_set = false;
  bool minor = false;                         // below max(5 % of the RMSE, the tolerance)
  std::vector<std::string> inseparable_from;  // labels
  // Labels of effects that as fitted draw the same curve: at the edge of their shapes they become this one.
  std::vector<std::string> also_drawn_by;
};

}  // namespace ballbar
