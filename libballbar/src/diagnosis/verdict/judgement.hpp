// From fitted sets of effects to one verdict.
#pragma once

#include <vector>

#include "diagnosis/search/ground.hpp"
#include "diagnosis/search/hypotheses.hpp"

namespace ballbar {

// refits: as rival_sets. Fills in what `result` says of candidates, verdict and reasons; base and p_anything stand.
void judge(const Hypotheses& now, const Series& rows, const Ground& ground, const std::vector<Refitted>& refits,
           const DiagnosisOptions& options, Diagnosis& result);

}  // namespace ballbar
