// One effect of a fitted set as a candidate for what is missing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/search/max_score_null.hpp"
#include "diagnosis/search/subset_fits.hpp"

namespace ballbar {

// Of a trace by least squares from there: a form error is easily taken for noise with a memory, under which the circle
// hardly counts and its RMSE may rise.
double rmse_after_um(const SubsetFits& now, const SubsetFit& with);

// Its parameters, amplitude and RMSE.
Candidate candidate_of(const SubsetFits& now, const SubsetFit& with, std::size_t place);

// All the tests of the effect at `place` beside the rest of the set; `doubts` empty where all are passed.
Candidate confirmed(const SubsetFits& now, const Series& data, const SubsetFit& with, std::size_t place,
                    const MaxScoreNull& null, const DiagnosisOptions& options);

// A shape lies on its bound: something like it, but not it.
bool is_at_the_edge(const Candidate& candidate);

// Effects that stand in the place of one of the best set in a competing set, one group for each; not what draws the
// same, nor what the competing set could do without.
std::vector<std::vector<BoundEffect>> groups_of(const SubsetFits& now, const Projected& seen, const SubsetFit& best,
                                                const std::vector<const SubsetFit*>& competitors);

}  // namespace ballbar
