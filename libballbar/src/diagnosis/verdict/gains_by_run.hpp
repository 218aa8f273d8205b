// Whether a gain is the same in every run.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/posterior/set_at.hpp"

namespace ballbar {

// Gains of the model and of the set that differ: chi^2 of one for each run against one for all, p below kSameGain over
// the number of gains. None of one run.
std::vector<GainByRun> gains_by_run(const Problem& problem, const Posterior& posterior, const EffectSet& set,
                                    const SetAt& at);

}  // namespace ballbar
