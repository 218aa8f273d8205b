// What sets of effects are held against: the model alone, the noise, and what a search finds where there is no effect.
#pragma once

#include "diagnosis/search/max_score_null.hpp"
#include "diagnosis/search/subset_fits.hpp"

namespace ballbar {

struct NullModel {
  Set first;                    // by which the noise is told
  Evaluations evaluated;        // on the way
  Noise noise;                  // beside it
  Noise base_noise;             // most likely for the model alone
  double log_likelihood = 0.0;  // of the model alone
  bool heavy_tails = false;     // of what the first set leaves
  Projected seen;
  MaxScoreNull null;
};
NullModel null_model_of(const SubsetFits& now, const Noise& start, const SearchOptions& options);

// By the best score of the search; readings far from the others count less where the noise has heavy tails.
struct Detected {
  double p_anything = 1.0;
  double smallest_um = 0.0;  // amplitude that would have been found, of the effect that shows best
  BoundEffect smallest;
};
Detected detected(const SubsetFits& now, const NullModel& null_model);

}  // namespace ballbar
