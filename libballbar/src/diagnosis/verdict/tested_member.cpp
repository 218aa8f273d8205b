#include "diagnosis/verdict/tested_member.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/thresholds.hpp"
#include "diagnosis/verdict/member_tests.hpp"
#include "series/folds.hpp"

namespace ballbar {
namespace {

std::size_t family_of_member(const Problem& problem, const EffectSet& set, std::size_t member) {
  return problem.library.signatures[set.signatures[member]].family;
}

}  // namespace

double log_bayes_factor_of_member(const Inference& inference, const EffectSet& set, std::size_t member) {
  const Problem& problem = *inference.problem;
  std::vector<std::size_t> rest = set.families;
  std::erase(rest, family_of_member(problem, set, member));
  const double with = log_bayes_factor(problem, inference.posterior, set.families);
  const double without = rest.empty() ? 0.0 : log_bayes_factor(problem, inference.posterior, rest);
  return std::isfinite(without) ? with - without : with;
}

Candidate described_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted,
                           std::size_t member) {
  const Problem& problem = *inference.problem;
  const std::size_t family = family_of_member(problem, set, member);
  Candidate one;
  one.bound = problem.library.families[family].bound;
  one.label = label_of(one.bound);
  one.p = inference.posterior.family[family];
  std::size_t first = 1;
  for (const Term& term : problem.model.terms) first += term.settings.size();
  for (std::size_t k = 0; k < member; ++k) {
    first += problem.library.families[family_of_member(problem, set, k)].bound.effect->parameters.size();
  }
  const auto begin = static_cast<std::ptrdiff_t>(first);
  const auto end = begin + static_cast<std::ptrdiff_t>(one.bound.effect->parameters.size());
  one.parameters.assign(fitted.parameters.begin() + begin, fitted.parameters.begin() + end);
  one.intervals.assign(fitted.intervals.begin() + begin, fitted.intervals.begin() + end);
  one.amplitude_um = fitted.amplitude_um[member];
  one.amplitude_sigma_um = fitted.amplitude_sigma_um[member];
  one.rmse_after_um = fitted.rmse_um;
  one.likelihood_ratio = log_bayes_factor_of_member(inference, set, member);
  return one;
}

Candidate tested_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted, const SetAt& at,
                        std::size_t member, std::size_t surrogates, std::uint64_t seed) {
  const Problem& problem = *inference.problem;
  Candidate one = described_member(inference, set, fitted, member);
  const Signature& signature = problem.library.signatures[set.signatures[member]];
  const std::vector<std::size_t> fold =
      folds_that_tell(problem.logged.series, problem.base.row, folds_of(problem.logged.series, problem.base.row),
                      problem.library.columns.middleCols(signature.first, signature.width));
  const MemberTests tests = member_tests(problem, inference.posterior, set, at, member, fold, surrogates, seed);
  one.p_same_gain = tests.p_same_gain;
  one.held_out_before_um = tests.held_out_before_um;
  one.held_out_after_um = tests.held_out_after_um;
  one.held_out_evidence = tests.held_out_evidence;
  one.gain = tests.gain;
  if (tests.surrogate) {
    one.best_surrogate_gain = tests.surrogate->gain;
    one.best_surrogate_fall = tests.surrogate->fall;
    one.beats_surrogates = tests.gain > tests.surrogate->gain;
  }
  one.doubts = doubts_of(tests, *one.bound.effect);
  return one;
}

}  // namespace ballbar
