#include "diagnosis/posterior/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "ballbar/internal/numerics/parallel.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/ibss.hpp"
#include "diagnosis/posterior/search.hpp"
#include "diagnosis/posterior/sets.hpp"

namespace ballbar {
namespace {

// A covariance of a mode, and the sum of single effects that IBSS finds there.
struct WeightedSum {
  std::size_t mode = 0;
  Covariance covariance;
  SumOfEffects sum;
  double log_weight = kLogZero;  // lower bound plus ln prior of the covariance
};

// Sorts single effects like the most similar ones of another sum, because the order of a sum is arbitrary.
void align(const std::vector<SingleEffect>& to, std::size_t identities, std::vector<SingleEffect>& effects) {
  const auto likeness = [](const SingleEffect& a, const SingleEffect& b) {
    return std::inner_product(a.alpha.begin(), a.alpha.end(), b.alpha.begin(), 0.0);
  };
  while (effects.size() < to.size()) {
    effects.emplace_back();
    effects.back().alpha.assign(identities, 0.0);
  }
  for (std::size_t l = 0; l < to.size(); ++l) {
    std::size_t best = l;
    for (std::size_t k = l + 1; k < effects.size(); ++k) {
      if (likeness(effects[k], to[l]) > likeness(effects[best], to[l])) best = k;
    }
    std::swap(effects[l], effects[best]);
  }
}

// Of one kind of discrepancy the sum that the search found, at the covariance beside it. Of the first mode the likelier
// of that and of the sum from nothing.
WeightedSum weighted_sum(const Problem& problem, const SearchResult& found, const Covariance& start,
                         std::size_t largest, bool is_first_mode) {
  WeightedSum best;
  std::vector<SumOfEffects> starts{found.sum};
  if (is_first_mode && !likeliest_set(found.sum).empty()) starts.emplace_back();
  for (const SumOfEffects& from : starts) {
    WeightedSum one;
    one.covariance = covariance_beside(problem, from, found.identities, found.linearisation.linear, start);
    one.sum = sum_at(problem, found.identities, found.linearisation.linear, one.covariance,
                     ibss_options(problem, found.identities, largest, Forms::yes), from);
    one.log_weight = one.sum.elbo + one.covariance.log_prior;
    if (one.log_weight > best.log_weight + problem.tuning.better) best = std::move(one);
  }
  return best;
}

// Sums of other modes that have come to the same effects as a likelier one of the same kind count once.
void keep_different(std::vector<WeightedSum>& found) {
  std::set<std::pair<Discrepancy, std::vector<std::size_t>>> known;
  std::erase_if(found, [&](const WeightedSum& one) {
    return !known.insert({discrepancy_of(one.covariance), sorted_set(one.sum)}).second;
  });
}

// The single effects of a mode, averaged over its sums.
PosteriorMode averaged(const std::vector<const WeightedSum*>& sums, const std::vector<double>& p,
                       std::size_t identities) {
  PosteriorMode mode{std::accumulate(p.begin(), p.end(), 0.0), {}};
  std::size_t count = 0;
  for (const WeightedSum* one : sums) count = std::max(count, one->sum.effects.size());
  mode.effects.assign(count, {std::vector<double>(identities, 0.0)});
  for (std::size_t g = 0; g < sums.size(); ++g) {
    std::vector<SingleEffect> effects = sums[g]->sum.effects;
    if (g > 0) align(sums.front()->sum.effects, identities, effects);
    for (std::size_t l = 0; l < effects.size(); ++l) {
      for (std::size_t i = 0; i < identities; ++i) mode.effects[l].alpha[i] += p[g] / mode.p * effects[l].alpha[i];
    }
  }
  return mode;
}

// found: the likeliest first.
Posterior posterior_over(Problem& problem, std::vector<SearchResult>& modes, const std::vector<WeightedSum>& found) {
  Posterior result;
  std::vector<double> p;
  p.reserve(found.size());
  for (const WeightedSum& one : found) p.push_back(std::exp(one.log_weight - found.front().log_weight));
  const double total = std::accumulate(p.begin(), p.end(), 0.0);
  for (double& one : p) one /= total;
  const Identities& identities = modes[found.front().mode].identities;
  const std::size_t count = identities.log_prior.size();
  std::vector<double> included(count, 0.0);
  result.nothing = result.none = result.discrepancy = 0.0;
  for (std::size_t g = 0; g < found.size(); ++g) {
    double none = 1.0;
    for (const SingleEffect& one : found[g].sum.effects) none *= one.p_none();
    const std::vector<double> of_sum = inclusion_probabilities(found[g].sum, count);
    for (std::size_t i = 0; i < count; ++i) included[i] += p[g] * of_sum[i];
    const bool slow = found[g].covariance.slow > 0.0;
    result.none += p[g] * none;
    if (slow) result.discrepancy += p[g];
    if (!slow) result.nothing += p[g] * none;
    result.filters.push_back(noise_filter_at(problem, found[g].covariance));
  }
  const auto families = static_cast<std::ptrdiff_t>(identities.families);
  result.family.assign(included.begin(), included.begin() + families);
  result.held.assign(included.begin() + families, included.end());
  std::vector<ModeOfSets> of_sets;
  std::set<std::size_t> known;
  for (std::size_t g = 0; g < found.size(); ++g) {
    const std::size_t mode = found[g].mode;
    if (!known.insert(mode).second) continue;
    std::vector<const WeightedSum*> sums;
    std::vector<double> p_of;
    for (std::size_t h = g; h < found.size(); ++h) {
      if (found[h].mode != mode) continue;
      sums.push_back(&found[h]);
      p_of.push_back(p[h]);
    }
    result.modes.push_back(averaged(sums, p_of, count));
    result.linearisations.push_back(modes[mode].linearisation);
    of_sets.push_back({g, modes[mode].identities, found[g].sum});
  }
  add_sets(problem, of_sets, result);
  result.kinds = std::move(modes[found.front().mode].covariances);
  result.identities = std::move(modes[found.front().mode].identities);
  return result;
}

}  // namespace

double SinglePosterior::p_any() const { return std::accumulate(alpha.begin(), alpha.end(), 0.0); }

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior posterior_of(Problem& problem, std::size_t largest, std::vector<SearchResult> modes) {
  std::vector<std::pair<std::size_t, Covariance>> starts;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    for (const Covariance& kind : modes[m].covariances) starts.emplace_back(m, kind);
  }
  std::vector<WeightedSum> found(starts.size());
  in_parallel(found.size(), [&](std::size_t g) {
    const auto& [mode, covariance] = starts[g];
    found[g] = weighted_sum(problem, modes[mode], covariance, largest, mode == 0);
    found[g].mode = mode;
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const WeightedSum& a, const WeightedSum& b) { return a.log_weight > b.log_weight; });
  const double far = found.front().log_weight - problem.tuning.far_from_best;
  std::erase_if(found, [&](const WeightedSum& one) { return one.log_weight < far; });
  keep_different(found);
  return posterior_over(problem, modes, found);
}

}  // namespace ballbar
