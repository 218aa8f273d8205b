// From fitted sets of effects to one verdict.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/search/null_model.hpp"
#include "diagnosis/search/subset_fits.hpp"

namespace ballbar {

struct Finding {
  Verdict verdict = Verdict::nothing;
  std::vector<BoundEffect> named;
  std::vector<std::vector<BoundEffect>> equivalent;  // each: effects of which one is it
  std::vector<Candidate> associations;               // unexplained: what it goes with
  std::vector<std::string> reasons;                  // whole sentences
};

struct Findings {
  Finding finding;
  std::vector<Candidate> candidates;     // the best set first, then its competitors
  double smooth_likelihood_ratio = 0.0;  // 2 ln L gained by the most likely smooth curve
};

// base: the fit of the model alone to `rows`. refits: as competing_subsets.
Findings findings_of(const SubsetFits& now, const Series& rows, const Fit& base, const NullModel& null_model,
                     double p_anything, const std::vector<SubsetFit>& refits, const DiagnosisOptions& options);

}  // namespace ballbar
