// The error where a model was not fitted.
#pragma once

#include <vector>

#include "diagnosis/statistics/likelihood_ratio.hpp"

namespace ballbar {

// Each cycle's rows predicted from the others'. The model is taken as linear about its fit, so that shapes move too,
// by not much more than their own size, as it is not linear further; the cycle left out counts as a gap in the noise's
// memory. What the model has for that cycle alone, such as the circle of its recording, is fitted to it.
struct CrossValidation {
  double rmse_um = 0.0;  // of all rows
  double chi2 = 0.0;     // whitened by the noise within each cycle: what a slow noise adds to the RMSE counts little
};
// of_recordings: what moves in the cycle left out alone is that recording's own and fitted to it; in a drift series it
// is predicted by nothing.
CrossValidation cross_validation(const LinearisedFit& linearised, const Noise& noise,
                                 const std::vector<std::size_t>& fold, bool of_recordings);

}  // namespace ballbar
