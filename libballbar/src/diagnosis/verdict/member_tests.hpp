// A member of a set as a candidate: what it adds, how probable it is, and its tests beside the others, which a
// posterior cannot replace.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/candidate.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/posterior/set_at.hpp"
#include "diagnosis/verdict/fitted_set.hpp"

namespace ballbar {

// The candidate with its tests: gains of cycles, cycles left out, fall of chi^2, surrogates. fold: of each of the n
// rows. seed, surrogates: which and how many.
Candidate with_tests(Candidate one, const Problem& problem, const Posterior& posterior, const EffectSet& set,
                     const SetAt& at, std::size_t member, const std::vector<std::size_t>& fold, std::size_t surrogates,
                     std::uint64_t seed);

// RMSE of cycles (recordings) left out, each predicted from the others, of the model alone.
double held_out_um(const Inference& inference);

// Phrases of Candidate::doubts.
std::vector<std::string> doubts_of(const Candidate& tested, const Effect& effect);

// `member` of the set: its parameters, intervals and amplitude, its probability, its likelihood ratio
// beside the others.
Candidate described_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted,
                           std::size_t member);

// The same with its tests. surrogates: how many, 0: none.
Candidate tested_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted, const SetAt& at,
                        std::size_t member, std::size_t surrogates, std::uint64_t seed);

// 2 ln of how much more likely the readings are with the set than without this member.
double log_bayes_factor_of_member(const Inference& inference, const EffectSet& set, std::size_t member);

}  // namespace ballbar
