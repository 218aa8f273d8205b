#include "diagnosis/posterior/pairs.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/posterior/seen.hpp"
#include "diagnosis/posterior/set_prior.hpp"

namespace ballbar {
namespace {

using FoundPairs = std::map<SetKey, FoundSet>;

constexpr std::size_t kFewestShapes = 3, kMostShapes = 14;  // of a family on the thin grid

// Shapes of these families, so many of each.
Chosen shapes_of_families(const Problem& problem, const std::vector<std::size_t>& families, std::size_t each) {
  std::vector<std::size_t> shapes;
  for (const std::size_t family : families) {
    const std::vector<std::size_t> more = thinned_shapes(problem.library.families[family], each);
    shapes.insert(shapes.end(), more.begin(), more.end());
  }
  std::sort(shapes.begin(), shapes.end());
  return chosen_of(problem, std::move(shapes));
}

// ln of the prior of a family's chosen shapes together.
double log_prior_of_chosen(const Problem& problem, const Chosen& chosen, const std::vector<std::size_t>& places) {
  std::vector<double> priors;
  priors.reserve(places.size());
  for (const std::size_t k : places) priors.push_back(problem.log_prior_of_shape[chosen.signatures[k]]);
  return log_sum(priors);
}

// Every shape of one family with every one of another, by their places; prior: ln of that of the pair and the point.
FoundSet found_pair(const Problem& problem, const Chosen& chosen, const Seen& seen, const std::vector<std::size_t>& a,
                    const std::vector<std::size_t>& b, double prior) {
  FoundSet found;
  std::vector<double> shapes;
  for (const std::size_t i : a) {
    if (!seen.survives(chosen.first[i])) continue;
    for (const std::size_t j : b) {
      if (!seen.survives(chosen.first[j])) continue;
      const double evidence = log_evidence_of_pair(chosen, seen, i, j);
      if (evidence == kLogZero) continue;
      const std::size_t one = chosen.signatures[i], other = chosen.signatures[j];
      shapes.push_back(evidence + prior + problem.log_prior_of_shape[one] + problem.log_prior_of_shape[other]);
      if (shapes.back() > found.most) {
        found.most = shapes.back();
        found.signatures = {one, other};
      }
    }
  }
  found.log_weight = log_sum(shapes);
  return found;
}

// Every pair of families of the chosen signatures at one point. only: of these pairs; empty: of all.
FoundPairs pairs_among(const Problem& problem, const Point& point, const Variant& variant, const Chosen& chosen,
                       const std::set<SetKey>& only) {
  const Seen seen = seen_with_products(problem, point, variant, chosen.columns);
  std::map<std::size_t, std::vector<std::size_t>> of_family;  // places
  for (std::size_t k = 0; k < chosen.signatures.size(); ++k)
    of_family[problem.library.signatures[chosen.signatures[k]].family].push_back(k);
  FoundPairs found;
  for (auto a = of_family.begin(); a != of_family.end(); ++a) {
    for (auto b = std::next(a); b != of_family.end(); ++b) {
      const SetKey key{variant.own, {a->first, b->first}};
      if (!only.empty() && only.count(key) == 0) continue;
      const double prior = log_prior_of_set(problem, key.families, key.own) + point.covariance.log_prior -
                           log_prior_of_chosen(problem, chosen, a->second) -
                           log_prior_of_chosen(problem, chosen, b->second);
      found[key] = found_pair(problem, chosen, seen, a->second, b->second, prior);
    }
  }
  return found;
}

std::vector<FoundPairs> pairs_at(const Problem& problem, const SetTable& table, std::size_t variant,
                                 const std::vector<std::size_t>& points, const Chosen& chosen,
                                 const std::set<SetKey>& only = {}) {
  std::vector<FoundPairs> found(points.size());
  in_parallel(points.size(), [&](std::size_t k) {
    found[k] = pairs_among(problem, table.points[points[k]], table.variants[variant], chosen, only);
  });
  return found;
}

// The best first, each by its weight at its best point.
std::vector<std::pair<double, SetKey>> in_order(const std::vector<FoundPairs>& found) {
  std::map<SetKey, double> weight;
  for (const FoundPairs& at_point : found) {
    for (const auto& [key, pair] : at_point) {
      double& now = weight.try_emplace(key, kLogZero).first->second;
      now = std::max(now, pair.log_weight);
    }
  }
  std::vector<std::pair<double, SetKey>> order;
  for (const auto& [key, value] : weight) {
    if (value > kLogZero) order.emplace_back(value, key);
  }
  std::sort(order.rbegin(), order.rend());
  return order;
}

// Points in the order of this pair at its likeliest shapes: its two columns at every one.
std::vector<std::size_t> points_of_pair(const Problem& problem, const SetTable& table, std::size_t variant,
                                        const SetKey& pair) {
  std::vector<std::size_t> points(table.points.size());
  std::iota(points.begin(), points.end(), std::size_t{0});
  const std::vector<FoundSet>& at = table.sets.at(pair);
  const std::optional<std::size_t> likeliest = likeliest_point(at);
  if (!likeliest) return {};
  const Chosen best = chosen_of(problem, at[*likeliest].signatures);
  std::vector<FoundPairs> found = pairs_at(problem, table, variant, points, best);
  std::sort(points.begin(), points.end(),
            [&](std::size_t a, std::size_t b) { return found[a][pair].log_weight > found[b][pair].log_weight; });
  points.resize(std::min(points.size(), kPairPoints));
  return points;
}

}  // namespace

std::vector<std::size_t> weigh_pairs(const Problem& problem, SetTable& table, std::size_t variant) {
  if (problem.library.families.size() < 2) return {};
  const std::size_t own = table.variants[variant].own;
  const std::vector<std::size_t> strongest = strongest_families(problem, table, own, kFamiliesInPairs);
  const std::size_t thin =
      std::clamp(kShapesInPairs / std::max<std::size_t>(1, strongest.size()), kFewestShapes, kMostShapes);
  const std::vector<std::size_t> likely = best_points(table, own, kPairPoints);
  std::vector<FoundPairs> found =
      pairs_at(problem, table, variant, likely, shapes_of_families(problem, strongest, thin));
  const std::vector<std::pair<double, SetKey>> order = in_order(found);
  table.add(likely, variant, std::move(found));
  if (order.empty()) return {};

  std::set<SetKey> best;
  std::vector<std::size_t> families;
  for (const auto& [weight, pair] : order) {
    if (best.size() == kPairsRefined || weight < order.front().first - kFarFromBest) break;
    best.insert(pair);
    for (const std::size_t family : pair.families) {
      if (std::find(families.begin(), families.end(), family) == families.end()) families.push_back(family);
    }
  }
  const std::size_t fine = std::clamp(kColumnsRefined / families.size(), kThinShapes, kShapesRefined);
  std::vector<std::size_t> points = points_of_pair(problem, table, variant, order.front().second);
  table.add(points, variant,
            pairs_at(problem, table, variant, points, shapes_of_families(problem, families, fine), best));
  return points;
}

void weigh_pair(const Problem& problem, SetTable& table, std::size_t variant, const SetKey& pair) {
  const std::vector<std::size_t> points = best_points(table, pair.own, kPairPoints);
  const Chosen shapes = shapes_of_families(problem, pair.families, kShapesRefined);
  table.add(points, variant, pairs_at(problem, table, variant, points, shapes));
}

}  // namespace ballbar
