// A sum of single effects at one covariance by iterative Bayesian stepwise selection (IBSS): coordinate ascent on the
// evidence lower bound (Wang, Sarkar, Carbonetto and Stephens 2020, J. R. Stat. Soc. B 82, 1273, algorithm 1).
//
// The single effects are fitted in turn to the residual of the others until the bound stops rising. Then another one is
// added, until the next has less than half a unit of probability.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/single_effect_regression.hpp"

namespace ballbar {

struct SumOfEffects {
  std::vector<SingleEffect> effects;  // the last one has less than half, or the largest number is reached
  double elbo = 0.0;                  // lower bound of ln of the evidence
  double variance = 0.0;              // of the scatter
};

struct IbssOptions {
  std::vector<SinglePrior> priors;     // of each single effect; the last one applies to all further ones
  std::size_t least = 0, largest = 0;  // number of single effects
  KnownScatter known;
  double least_variance = 0.0;  // of the scatter, from rounding
  Tuning tuning = {};
};

// Whether inputs in any form are identities. While the shapes of effects are as coarse as their grid they are not: the
// error of the grid is many times the noise where an effect is large, and a form would take it.
enum class Forms { no, yes };

// largest: largest number of single effects.
IbssOptions ibss_options(const Problem& problem, const Identities& identities, std::size_t largest, Forms forms);

// With one single effect for each of these identities, and no others.
IbssOptions with_exactly(IbssOptions options, const std::vector<std::size_t>& set);

// start: the initial state. Settles the columns at the scatter found.
SumOfEffects ibss(ProjectedColumns& at, const Identities& identities, const IbssOptions& options,
                  SumOfEffects start = {});

// The same at a covariance.
SumOfEffects sum_at(const Problem& problem, const Identities& identities, const LinearModel& linear,
                    const Covariance& covariance, const IbssOptions& options, SumOfEffects start = {});

std::size_t likeliest_identity(const SingleEffect& one);

// The identity of each single effect that is more likely present than absent.
std::vector<std::size_t> likeliest_set(const SumOfEffects& sum);
std::vector<std::size_t> sorted_set(const SumOfEffects& sum);

// The posterior inclusion probability of each of this many identities: 1 - prod (1 - alpha).
std::vector<double> inclusion_probabilities(const SumOfEffects& sum, std::size_t identities);

// The most likely covariance of the same kind beside what the sum explains, from this one on; this one where the
// problem has given ones.
Covariance covariance_beside(const Problem& problem, const SumOfEffects& sum, const Identities& identities,
                             const LinearModel& linear, const Covariance& start);

// The model with the readings less what the single effects explain on average.
LinearModel less_mean_of(const SumOfEffects& sum, const Identities& identities, LinearModel linear);

}  // namespace ballbar
