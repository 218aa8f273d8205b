#include "diagnosis/posterior/triples.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/posterior/seen.hpp"
#include "diagnosis/posterior/set_prior.hpp"

namespace ballbar {
namespace {

// A pair and what may stand beside it.
struct Extended {
  SetKey pair;
  double shapes = 0.0;  // ln of what the pair's shapes are worth together, over the likeliest alone
  Chosen chosen;        // the pair's two, then shapes of other families
};

std::vector<Extended> extended_pairs(const Problem& problem, const SetTable& table, std::size_t own) {
  std::vector<std::pair<double, SetKey>> order;
  for (const auto& [key, at] : table.sets) {
    if (key.own == own && key.families.size() == 2) order.emplace_back(log_weight_of(at), key);
  }
  std::sort(order.rbegin(), order.rend());
  if (order.size() > kPairsExtended) order.resize(kPairsExtended);
  const std::vector<std::size_t> families = strongest_families(problem, table, own, kFamiliesInPairs);
  std::vector<Extended> result;
  for (const auto& [weight, key] : order) {
    const std::vector<FoundSet>& at = table.sets.at(key);
    const std::optional<std::size_t> likeliest = likeliest_point(at);
    if (!likeliest) continue;
    const FoundSet& best = at[*likeliest];
    std::vector<std::size_t> chosen = best.signatures;
    for (const std::size_t family : families) {
      if (family == key.families[0] || family == key.families[1]) continue;
      const std::vector<std::size_t> shapes = thinned_shapes(problem.library.families[family], kThinShapes);
      chosen.insert(chosen.end(), shapes.begin(), shapes.end());
    }
    result.push_back({key, best.log_weight - best.most, chosen_of(problem, std::move(chosen))});
  }
  return result;
}

// By the family of the third: ln of the evidence of each of its shapes, and the likeliest.
struct Third {
  std::vector<double> evidence;
  FoundSet likeliest;
};

std::map<std::size_t, Third> thirds_beside(const Problem& problem, const Chosen& chosen, const Seen& seen) {
  std::map<std::size_t, Third> thirds;
  for (std::size_t i = 2; i < chosen.signatures.size(); ++i) {
    if (!seen.survives(chosen.first[i])) continue;
    auto& [evidence, likeliest] = thirds[problem.library.signatures[chosen.signatures[i]].family];
    evidence.push_back(log_evidence_of_set(chosen, seen, {0, 1, i}));
    if (evidence.back() > likeliest.most) {
      likeliest.most = evidence.back();
      likeliest.signatures = {chosen.signatures[0], chosen.signatures[1], chosen.signatures[i]};
    }
  }
  return thirds;
}

std::map<SetKey, FoundSet> triples_at(const Problem& problem, const Point& point, const Variant& variant,
                                      const std::vector<Extended>& pairs) {
  std::map<SetKey, FoundSet> found;
  for (const auto& [pair, pair_shapes, chosen] : pairs) {
    const Seen seen = seen_with_products(problem, point, variant, chosen.columns);
    for (auto& [family, third] : thirds_beside(problem, chosen, seen)) {
      SetKey triple = pair;
      triple.families.push_back(family);
      std::sort(triple.families.begin(), triple.families.end());
      // The shapes of the first two are at their best alone: what they are worth as a share of their grid.
      const std::vector<Family>& families = problem.library.families;
      const double prior = log_prior_of_set(problem, triple.families, triple.own) + point.covariance.log_prior -
                           std::log(static_cast<double>(families[pair.families[0]].count)) -
                           std::log(static_cast<double>(families[pair.families[1]].count));
      FoundSet one = std::move(third.likeliest);
      one.log_weight =
          log_sum(third.evidence) - std::log(static_cast<double>(third.evidence.size())) + prior + pair_shapes;
      one.most += prior;
      FoundSet& there = found[triple];
      if (one.log_weight > there.log_weight) there = std::move(one);
    }
  }
  return found;
}

}  // namespace

void weigh_triples(const Problem& problem, SetTable& table, std::size_t variant,
                   const std::vector<std::size_t>& points) {
  const std::vector<Extended> pairs = extended_pairs(problem, table, table.variants[variant].own);
  std::vector<std::map<SetKey, FoundSet>> found(points.size());
  in_parallel(points.size(), [&](std::size_t k) {
    found[k] = triples_at(problem, table.points[points[k]], table.variants[variant], pairs);
  });
  table.add(points, variant, std::move(found));
}

}  // namespace ballbar
