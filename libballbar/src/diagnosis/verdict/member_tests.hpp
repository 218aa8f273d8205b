// A member of a set as a candidate: its contribution, probability, and tests with the other members present. The tests
// complement the posterior.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/posterior/set_regression.hpp"
#include "diagnosis/verdict/fitted_set.hpp"

namespace ballbar {

// The candidate with its tests: gains by cycle and left-out cycles. effect: of the member. fold: the fold of each of
// the n rows.
Candidate with_tests(Candidate one, const Effect& effect, const SetRegression& at, std::size_t member,
                     const std::vector<std::size_t>& fold, const Tuning& tuning = {});

// RMSE of the model in left-out cycles (recordings), each predicted from the others; NaN: unknown. Throws Error as
// fit() does.
double held_out_um(const Model& model, const Series& data, std::size_t target, const LoggedInputs* logged = nullptr);

// Sets held_out_before_um and held_out_after_um of candidates that are these terms of the model, as the ledger has
// them.
void leave_cycles_out(const Model& model, const std::vector<std::size_t>& terms, const Series& data, std::size_t target,
                      std::vector<Candidate>& candidates);

// Candidate::doubts, as far as these tests go.
std::vector<Doubt> doubts_of(const Candidate& tested, const Effect& effect, const Tuning& tuning = {});

// `member` of the set: parameters, intervals, amplitude, probability, and likelihood ratio with the other members
// present.
Candidate described_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted,
                           std::size_t member);

// The same with its tests.
Candidate tested_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted,
                        const SetRegression& at, std::size_t member);

// 2 ln of the Bayes factor of the set against the set without this member.
double log_bayes_factor_of_member(const Inference& inference, const EffectSet& set, std::size_t member);

// The same against the set with the families `rest` of it alone.
double log_bayes_factor_beside(const Inference& inference, const EffectSet& set, const std::vector<std::size_t>& rest);

}  // namespace ballbar
