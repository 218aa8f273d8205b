// What a posterior cannot replace: tests of one member of a set, beside the others.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/posterior/set_at.hpp"
#include "diagnosis/surrogates/surrogate_series.hpp"

namespace ballbar {

struct MemberTests {
  double p_same_gain = 1.0;        // of gains as different from cycle to cycle
  double held_out_evidence = 0.0;  // ln of the likelihood of cycles left out, gained; without the best cycle
  double held_out_before_um = 0.0, held_out_after_um = 0.0;
  double gain = 0.0;                       // fall of chi^2
  std::optional<BestSurrogate> surrogate;  // nothing: it has none
};

// fold: of each of the n rows. seed, surrogates: how many and which.
MemberTests member_tests(const Problem& problem, const Posterior& posterior, const EffectSet& set, const SetAt& at,
                         std::size_t member, const std::vector<std::size_t>& fold, std::size_t surrogates,
                         std::uint64_t seed);

// RMSE of cycles (recordings) left out, each predicted from the others, of the model alone.
double held_out_um(const Inference& inference);

// Phrases of Candidate::doubts.
std::vector<std::string> doubts_of(const MemberTests& tests, const Effect& effect);

}  // namespace ballbar
