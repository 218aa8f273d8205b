#include "diagnosis/posterior/wanted.hpp"

#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/posterior/pairs.hpp"
#include "diagnosis/posterior/seen.hpp"
#include "diagnosis/posterior/set_prior.hpp"

namespace ballbar {
namespace {

constexpr int kTurns = 2;  // of all members

// Of each family the shape that is likeliest alone; nothing: one of them has none.
std::optional<std::vector<std::size_t>> likeliest_alone(const SetTable& table,
                                                        const std::vector<std::size_t>& families) {
  std::vector<std::size_t> shapes;
  shapes.reserve(families.size());
  for (const std::size_t family : families) {
    const auto alone = table.sets.find({0, {family}});
    if (alone == table.sets.end()) return std::nullopt;
    const std::optional<std::size_t> best = likeliest_point(alone->second);
    if (!best) return std::nullopt;
    shapes.push_back(alone->second[*best].signatures.front());
  }
  return shapes;
}

// The set with the best of many shapes of one member in its place. Summed: over the shapes of that member.
FoundSet found_by_member(const Problem& problem, const Point& point, const Variant& variant, const SetKey& key,
                         std::vector<std::size_t> set, std::size_t member) {
  std::vector<std::size_t> tried = set;
  tried.erase(tried.begin() + static_cast<std::ptrdiff_t>(member));
  const std::size_t others = tried.size();
  const std::vector<std::size_t> shapes =
      thinned_shapes(problem.library.families[key.families[member]], kShapesRefined);
  tried.insert(tried.end(), shapes.begin(), shapes.end());
  const Chosen chosen = chosen_of(problem, std::move(tried));
  const Seen seen = seen_with_products(problem, point, variant, chosen.columns);
  std::vector<std::size_t> places(others + 1);
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::vector<double> evidence;
  evidence.reserve(shapes.size());
  double best = kLogZero;
  for (std::size_t i = others; i < chosen.signatures.size(); ++i) {
    places.back() = i;
    evidence.push_back(log_evidence_of_set(chosen, seen, places));
    if (evidence.back() > best) {
      best = evidence.back();
      set[member] = chosen.signatures[i];
    }
  }
  const double prior = log_prior_of_set(problem, key.families, key.own);
  FoundSet found;
  found.log_weight =
      log_sum(evidence) - std::log(static_cast<double>(evidence.size())) + prior + point.covariance.log_prior;
  found.most = best + prior + point.covariance.log_prior;
  found.signatures = std::move(set);
  return found;
}

}  // namespace

void weigh_wanted(const Problem& problem, SetTable& table, std::size_t variant, const SetKey& wanted) {
  if (wanted.families.size() < 2) return;
  if (wanted.families.size() == 2) {
    weigh_pair(problem, table, variant, wanted);
    return;
  }
  const std::optional<std::vector<std::size_t>> alone = likeliest_alone(table, wanted.families);
  if (!alone) return;
  const std::vector<std::size_t> points = best_points(table, 0, kPairPoints);
  std::vector<std::map<SetKey, FoundSet>> found(points.size());
  in_parallel(points.size(), [&](std::size_t k) {
    FoundSet one;
    one.signatures = *alone;
    for (int turn = 0; turn < kTurns; ++turn) {
      for (std::size_t member = 0; member < alone->size(); ++member) {
        one = found_by_member(problem, table.points[points[k]], table.variants[variant], wanted,
                              std::move(one.signatures), member);
      }
    }
    found[k][wanted] = std::move(one);
  });
  table.add(points, variant, std::move(found));
}

}  // namespace ballbar
