// Whether a gain is the same in every run.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

// The gains of the model and of the set that differ between runs: chi^2 of separate gains against a common one, with p
// below `same_gain` over the number of gains. Empty for one run.
std::vector<GainByRun> gains_by_run(const Problem& problem, const Posterior& posterior, const EffectSet& set);

}  // namespace ballbar
