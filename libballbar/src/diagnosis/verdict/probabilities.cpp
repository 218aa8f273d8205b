#include "diagnosis/verdict/probabilities.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

bool is_in(const std::vector<std::size_t>& list, std::size_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

// Sets that together hold 95 % of the posterior.
std::vector<const EffectSet*> credible_sets(const Posterior& posterior) {
  std::vector<const EffectSet*> sets;
  double sum = 0.0;
  for (const EffectSet& set : posterior.sets) {
    sets.push_back(&set);
    sum += posterior.p(set);
    if (sum >= kCredible) break;
  }
  return sets;
}

// The sets' priors taken off again; a slow discrepancy counts on both sides.
double log_bayes_factor_of(const Problem& problem, const Posterior& posterior) {
  std::vector<double> something, none;
  something.reserve(posterior.sets.size());
  none.reserve(posterior.sets.size());
  for (const EffectSet& set : posterior.sets)
    (set.own == 0 && set.families.empty() ? none : something).push_back(set.log_weight);
  if (something.empty()) return 0.0;
  const double p_none = kPriorOfSize[0] * (problem.own.empty() ? 1.0 : 1.0 - kPriorOfOwn);
  return log_sum(something) - log_sum(none) - std::log((1.0 - p_none) / p_none);
}

}  // namespace

Probabilities probabilities_of(const Problem& problem, const Posterior& posterior) {
  Probabilities result;
  result.family.assign(problem.effects, 0.0);
  result.own.assign(problem.own.size(), 0.0);
  for (const EffectSet& set : posterior.sets) {
    const double p = posterior.p(set), slow = std::exp(set.log_weight_slow - posterior.log_total);
    result.discrepancy += slow;
    if (set.own > 0) result.own[set.own - 1] += p;
    if (set.own == 0 && set.families.empty()) result.nothing += p - slow;
    std::set<std::string> columns;
    const double without_slow = p - slow;
    bool driven = set.own > 0;
    for (const std::size_t family : set.families) {
      const BoundEffect& bound = problem.library.families[family].bound;
      result.family[family] += p;
      columns.insert(bound.columns.begin(), bound.columns.end());
      driven = driven || !bound.effect->time_only;
    }
    if (!driven && !set.families.empty()) result.time_alone += p;
    for (const std::string& column : columns) result.column[column] += without_slow;
  }
  result.log_bayes_factor = log_bayes_factor_of(problem, posterior);
  return result;
}

std::vector<Driver> drivers_of(const Posterior& posterior, const Problem& problem,
                               const std::map<std::string, double>& by_effects) {
  std::vector<double> logs{posterior.log_total};
  for (const EffectSet& one : posterior.any_form) {
    if (one.own == 0) logs.push_back(one.log_weight);
  }
  const double total = log_sum(logs);
  std::map<std::string, double> p;
  for (const auto& [column, of_effects] : by_effects) p[column] = of_effects * std::exp(posterior.log_total - total);
  for (const EffectSet& one : posterior.any_form) {
    const double fast =
        one.log_weight_slow > -1e300
            ? one.log_weight + std::log1p(-std::min(1.0 - 1e-12, std::exp(one.log_weight_slow - one.log_weight)))
            : one.log_weight;
    if (one.own == 0) p[problem.library.families[one.families.front()].bound.columns.front()] += std::exp(fast - total);
  }
  std::vector<Driver> drivers;
  for (const auto& [column, of_all] : p) {
    if (of_all >= 0.5) drivers.push_back({column, of_all});
  }
  std::stable_sort(drivers.begin(), drivers.end(), [](const Driver& a, const Driver& b) { return a.p > b.p; });
  return drivers;
}

std::vector<std::vector<std::size_t>> groups_of(const Posterior& posterior, const EffectSet& best,
                                                const std::vector<double>& p) {
  const std::vector<const EffectSet*> credible = credible_sets(posterior);
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t member : best.families) {
    std::vector<std::size_t> group{member};
    for (const EffectSet* set : credible) {
      if (is_in(set->families, member)) continue;  // what it has more stands beside it
      std::size_t shared = 0;
      std::vector<std::size_t> others;
      for (const std::size_t family : set->families) {
        if (is_in(best.families, family)) {
          ++shared;
        } else {
          others.push_back(family);
        }
      }
      if (shared + 1 < best.families.size()) continue;
      for (const std::size_t other : others) {
        if (!is_in(group, other)) group.push_back(other);
      }
    }
    std::stable_sort(group.begin(), group.end(), [&](std::size_t a, std::size_t b) { return p[a] > p[b]; });
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace ballbar
