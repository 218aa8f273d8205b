#include "diagnosis/posterior/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/search.hpp"
#include "diagnosis/posterior/sets.hpp"
#include "diagnosis/posterior/weighted_ascent.hpp"

namespace ballbar {
namespace {

constexpr double kFarFromBest = 7.0;     // ln: covariances this far are left out
constexpr double kBetterOptimum = 0.05;  // ln

// Sorts single effects like the most similar ones of another sum, because the order of a sum is arbitrary.
void align(const std::vector<SingleEffect>& to, std::size_t identities, std::vector<SingleEffect>& effects) {
  const auto likeness = [](const SingleEffect& a, const SingleEffect& b) {
    return std::inner_product(a.p.begin(), a.p.end(), b.p.begin(), 0.0);
  };
  while (effects.size() < to.size()) {
    effects.emplace_back();
    effects.back().p.assign(identities, 0.0);
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
WeightedAscent ascended_at(const Problem& problem, const SearchResult& found, const Covariance& start,
                           std::size_t largest) {
  WeightedAscent best;
  std::vector<Ascent> starts{found.ascent};
  if (!likeliest_set(found.ascent).empty()) starts.emplace_back();
  for (const Ascent& from : starts) {
    WeightedAscent one;
    Covariance covariance = start;
    if (problem.covariances.empty()) {
      const Variant beside = beside_mean_of(from, found.identities, found.variant);
      covariance = likeliest_covariance(problem, beside, discrepancy_of(start), &start);
    }
    one.point = point_at(problem, covariance);
    ColumnsAt at(problem, found.identities, found.variant, one.point);
    one.ascent = ascended(at, found.identities, ascent_options(problem, found.identities, largest, Forms::yes), from);
    one.log_weight = one.ascent.bound + covariance.log_prior;
    if (one.log_weight > best.log_weight + kBetterOptimum) best = std::move(one);
  }
  return best;
}

Posterior averaged(Problem& problem, SearchResult searched, std::vector<WeightedAscent> found) {
  Posterior result;
  const Identities& identities = searched.identities;
  std::vector<double>& weight = result.weight;
  for (const WeightedAscent& one : found) weight.push_back(std::exp(one.log_weight - found.front().log_weight));
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
  for (double& one : weight) one /= total;
  const std::size_t count = identities.log_prior.size();
  for (std::size_t g = 1; g < found.size(); ++g) align(found.front().ascent.effects, count, found[g].ascent.effects);
  std::size_t effects = 0;
  for (const WeightedAscent& one : found) effects = std::max(effects, one.ascent.effects.size());
  result.effects.assign(effects, {std::vector<double>(count, 0.0)});
  std::vector<double> p(count, 0.0);
  result.nothing = result.none = result.discrepancy = 0.0;
  for (std::size_t g = 0; g < found.size(); ++g) {
    double none = 1.0;
    std::vector<double> without(count, 1.0);
    for (std::size_t l = 0; l < found[g].ascent.effects.size(); ++l) {
      const SingleEffect& one = found[g].ascent.effects[l];
      for (std::size_t i = 0; i < count; ++i) {
        result.effects[l].p[i] += weight[g] * one.p[i];
        without[i] *= std::max(0.0, 1.0 - one.p[i]);
      }
      none *= one.p_none();
    }
    for (std::size_t i = 0; i < count; ++i) p[i] += weight[g] * (1.0 - without[i]);
    const bool slow = found[g].point.covariance.slow > 0.0;
    result.none += weight[g] * none;
    if (slow) result.discrepancy += weight[g];
    if (!slow) result.nothing += weight[g] * none;
  }
  const auto families = static_cast<std::ptrdiff_t>(identities.families);
  result.family.assign(p.begin(), p.begin() + families);
  result.own.assign(p.begin() + families, p.end());
  result.kinds = std::move(searched.covariances);
  result.variants.push_back(std::move(searched.variant));
  const Ascent likeliest = std::move(found.front().ascent);
  for (WeightedAscent& one : found) result.points.push_back(std::move(one.point));
  result.identities = std::move(searched.identities);
  add_sets(problem, result.identities, likeliest, result);
  return result;
}

}  // namespace

double SinglePosterior::p_any() const { return std::accumulate(p.begin(), p.end(), 0.0); }

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior posterior_of(Problem& problem, std::size_t largest,
                       const std::function<void(const std::vector<double>&)>& so_far) {
  SearchResult searched = search_result(problem, largest);
  std::vector<WeightedAscent> found(searched.covariances.size());
  in_parallel(found.size(),
              [&](std::size_t g) { found[g] = ascended_at(problem, searched, searched.covariances[g], largest); });
  sort_by_weight(found);
  const double far = found.front().log_weight - kFarFromBest;
  std::erase_if(found, [&](const WeightedAscent& one) { return one.log_weight < far; });
  Posterior result = averaged(problem, std::move(searched), std::move(found));
  if (so_far) so_far(result.family);
  return result;
}

}  // namespace ballbar
