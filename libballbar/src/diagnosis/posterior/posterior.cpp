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

namespace ballbar {
namespace {

constexpr double kFarFromBest = 7.0;     // ln: covariances this far are left out
constexpr int kRounds = 2;               // of the covariance and the sum beside it
constexpr double kNearBest = 3.0;        // ln: covariances this near represent all in the search for other modes
constexpr double kBetterOptimum = 0.05;  // ln
constexpr double kAlone = 0.9;           // P of an identity in its single effect; excluding it gives another mode

// ln of the total weight of the first few.
double log_weight_of(const std::vector<WeightedAscent>& found, std::size_t count) {
  std::vector<double> weights;
  for (std::size_t g = 0; g < std::min(count, found.size()); ++g) weights.push_back(found[g].log_weight);
  return log_sum(weights);
}

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

class Average {
 public:
  Average(Problem& problem, std::size_t largest, SearchResult searched)
      : problem_(problem), largest_(largest), searched_(std::move(searched)) {}

  Posterior run() {
    std::vector<WeightedAscent> found;
    for (const Covariance& one : searched_.covariances)
      found.push_back({point_at(problem_, one), searched_.best.ascent, kLogZero});
    ascend(found, problem_.tuning.settled_twice ? kRounds : 1);
    if (problem_.tuning.rivals_in_place) take_better_optimum(found);
    leave_out_far(found);
    if (!problem_.tuning.all_kinds) found.resize(1);
    if (problem_.tuning.other_modes) add_modes(found);
    return averaged(std::move(found));
  }

 private:
  const Identities& identities() const { return searched_.identities; }

  void ascend_at(WeightedAscent& one) const {
    ColumnsAt at(problem_, identities(), searched_.variant, one.point);
    const AscentOptions options = ascent_options(problem_, identities(), largest_, Forms::yes);
    one.ascent = ascended(at, identities(), options, one.ascent);
    Ascent other = best_ascent(at, problem_, identities(), options, {});
    if (other.bound > one.ascent.bound + kBetterOptimum) one.ascent = std::move(other);
    one.log_weight = one.ascent.bound + one.point.covariance.log_prior;
  }

  // Of each kind of discrepancy: the sum at its covariance, and the covariance beside that sum.
  void ascend(std::vector<WeightedAscent>& found, int rounds) const {
    const bool is_given = !problem_.covariances.empty();
    in_parallel(found.size(), [&](std::size_t g) {
      WeightedAscent best;
      for (int round = 0; round < (is_given ? 1 : rounds); ++round) {
        WeightedAscent next = found[g];
        if (!is_given) {
          const Variant beside = beside_mean_of(next.ascent, identities(), searched_.variant);
          const Covariance& before = next.point.covariance;
          next.point = point_at(problem_, likeliest_covariance(problem_, beside, discrepancy_of(before), &before));
        }
        ascend_at(next);
        found[g] = next;
        if (round == 0 || next.log_weight > best.log_weight) best = std::move(next);
      }
      found[g] = std::move(best);
    });
    sort_by_weight(found);
  }

  // A better optimum at the likeliest covariance is one everywhere.
  void take_better_optimum(std::vector<WeightedAscent>& found) {
    const ColumnsAt at(problem_, identities(), searched_.variant, found.front().point);
    const Ascent best = rearranged(at, identities(), ascent_options(problem_, identities(), largest_, Forms::yes),
                                   found.front().ascent);
    if (!(best.bound > found.front().ascent.bound + kBetterOptimum)) return;
    for (WeightedAscent& one : found) one.ascent.effects = best.effects;
    ascend(found, 1);
  }

  static void leave_out_far(std::vector<WeightedAscent>& found) {
    const double far = found.front().log_weight - kFarFromBest;
    std::erase_if(found, [&](const WeightedAscent& one) { return one.log_weight < far; });
  }

  // The modes of the search; and its best sum, where another one has proved likelier since.
  std::vector<Mode> modes_beside(const std::vector<std::size_t>& best_set) const {
    std::vector<Mode> modes = searched_.modes;
    const std::vector<std::size_t> searched = likeliest_set(searched_.best.ascent);
    for (const std::size_t i : best_set) {
      if (std::find(searched.begin(), searched.end(), i) == searched.end()) modes.push_back({i, searched});
    }
    return modes;
  }

  // Coordinate ascent finds one mode. Other modes have weight too: an identity that is certain in this mode may be
  // absent in another one.
  void add_modes(std::vector<WeightedAscent>& found) {
    const double near = found.front().log_weight - kNearBest;
    const auto count = static_cast<std::size_t>(
        std::count_if(found.begin(), found.end(), [&](const WeightedAscent& one) { return one.log_weight >= near; }));
    const double represented = log_weight_of(found, found.size()) - log_weight_of(found, count);
    const std::vector<SingleEffect> best = found.front().ascent.effects;
    const std::vector<std::size_t> best_set = likeliest_set(found.front().ascent);
    for (const Mode& mode : modes_beside(best_set)) {
      const auto is_it = [&](const SingleEffect& one) { return one.p[mode.without] >= kAlone; };
      if (std::none_of(best.begin(), best.end(), is_it)) continue;
      const std::size_t first = found.size();
      for (std::size_t g = 0; g < count; ++g) found.push_back(found[g]);
      in_parallel(count, [&](std::size_t g) {
        WeightedAscent& one = found[first + g];
        ColumnsAt at(problem_, identities(), searched_.variant, one.point);
        one.ascent = ascended_from(
            at, identities(), ascent_options(problem_, identities(), largest_, Forms::yes, mode.without), mode.set);
        one.log_weight = one.ascent.bound + one.point.covariance.log_prior + represented;
      });
    }
    sort_by_weight(found);
    leave_out_far(found);
  }

  Posterior averaged(std::vector<WeightedAscent> found) {
    Posterior result;
    std::vector<double>& weight = result.weight;
    for (const WeightedAscent& one : found) weight.push_back(std::exp(one.log_weight - found.front().log_weight));
    const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (double& one : weight) one /= total;
    const std::size_t count = identities().log_prior.size();
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
    const auto families = static_cast<std::ptrdiff_t>(identities().families);
    result.family.assign(p.begin(), p.begin() + families);
    result.own.assign(p.begin() + families, p.end());
    result.kinds = searched_.covariances;
    result.variants.push_back(std::move(searched_.variant));
    const Ascent likeliest = std::move(found.front().ascent);
    for (WeightedAscent& one : found) result.points.push_back(std::move(one.point));
    result.identities = std::move(searched_.identities);
    add_sets(problem_, result.identities, likeliest, result);
    return result;
  }

  Problem& problem_;
  std::size_t largest_;
  SearchResult searched_;
};

}  // namespace

double SinglePosterior::p_any() const { return std::accumulate(p.begin(), p.end(), 0.0); }

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior posterior_of(Problem& problem, std::size_t largest,
                       const std::function<void(const std::vector<double>&)>& so_far) {
  Posterior result = Average(problem, largest, search_result(problem, largest)).run();
  if (so_far) so_far(result.family);
  return result;
}

}  // namespace ballbar
