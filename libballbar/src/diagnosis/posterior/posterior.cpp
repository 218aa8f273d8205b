#include "diagnosis/posterior/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "ballbar/internal/numerics/parallel.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/ibss.hpp"
#include "diagnosis/posterior/search.hpp"
#include "diagnosis/posterior/sets.hpp"

namespace ballbar {
namespace {

// A covariance, and the sum of single effects that IBSS finds there.
struct WeightedSum {
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

// Of one kind of discrepancy the likelier of two sums, each at the covariance beside it: from the one that the search
// found, and from nothing.
WeightedSum weighted_sum(const Problem& problem, const SearchResult& found, const Covariance& start,
                         std::size_t largest) {
  WeightedSum best;
  std::vector<SumOfEffects> starts{found.sum};
  if (!likeliest_set(found.sum).empty()) starts.emplace_back();
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

Posterior averaged(Problem& problem, SearchResult searched, std::vector<WeightedSum> found) {
  Posterior result;
  const Identities& identities = searched.identities;
  std::vector<double> weight;
  for (const WeightedSum& one : found) weight.push_back(std::exp(one.log_weight - found.front().log_weight));
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
  for (double& one : weight) one /= total;
  const std::size_t count = identities.log_prior.size();
  for (std::size_t g = 1; g < found.size(); ++g) align(found.front().sum.effects, count, found[g].sum.effects);
  std::size_t effects = 0;
  for (const WeightedSum& one : found) effects = std::max(effects, one.sum.effects.size());
  result.effects.assign(effects, {std::vector<double>(count, 0.0)});
  std::vector<double> p(count, 0.0);
  result.nothing = result.none = result.discrepancy = 0.0;
  for (std::size_t g = 0; g < found.size(); ++g) {
    double none = 1.0;
    std::vector<double> without(count, 1.0);
    for (std::size_t l = 0; l < found[g].sum.effects.size(); ++l) {
      const SingleEffect& one = found[g].sum.effects[l];
      for (std::size_t i = 0; i < count; ++i) {
        result.effects[l].alpha[i] += weight[g] * one.alpha[i];
        without[i] *= std::max(0.0, 1.0 - one.alpha[i]);
      }
      none *= one.p_none();
    }
    for (std::size_t i = 0; i < count; ++i) p[i] += weight[g] * (1.0 - without[i]);
    const bool slow = found[g].covariance.slow > 0.0;
    result.none += weight[g] * none;
    if (slow) result.discrepancy += weight[g];
    if (!slow) result.nothing += weight[g] * none;
  }
  const auto families = static_cast<std::ptrdiff_t>(identities.families);
  result.family.assign(p.begin(), p.begin() + families);
  result.held.assign(p.begin() + families, p.end());
  result.kinds = std::move(searched.covariances);
  result.linearisations.push_back(std::move(searched.linearisation));
  const SumOfEffects likeliest = std::move(found.front().sum);
  for (const WeightedSum& one : found) result.filters.push_back(noise_filter_at(problem, one.covariance));
  result.identities = std::move(searched.identities);
  add_sets(problem, result.identities, likeliest, result);
  return result;
}

}  // namespace

double SinglePosterior::p_any() const { return std::accumulate(alpha.begin(), alpha.end(), 0.0); }

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior posterior_of(Problem& problem, std::size_t largest) {
  SearchResult searched = search_result(problem, largest);
  std::vector<WeightedSum> found(searched.covariances.size());
  in_parallel(found.size(),
              [&](std::size_t g) { found[g] = weighted_sum(problem, searched, searched.covariances[g], largest); });
  std::stable_sort(found.begin(), found.end(),
                   [](const WeightedSum& a, const WeightedSum& b) { return a.log_weight > b.log_weight; });
  const double far = found.front().log_weight - problem.tuning.far_from_best;
  std::erase_if(found, [&](const WeightedSum& one) { return one.log_weight < far; });
  return averaged(problem, std::move(searched), std::move(found));
}

}  // namespace ballbar
