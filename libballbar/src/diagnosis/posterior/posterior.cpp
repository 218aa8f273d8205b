#include "diagnosis/posterior/posterior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/posterior/search.hpp"
#include "diagnosis/posterior/sets.hpp"

namespace ballbar {
namespace {

constexpr double kPriorOfBackground = 0.03;
constexpr std::array<double, 2> kBackgrounds{6.0, kOfBackground};  // d of all of it together
constexpr std::size_t kNoisesWithMore = 3;  // the most likely ones, which get a discrepancy or a background
constexpr double kFarFromBest = 7.0;        // ln: covariances this far are left out
constexpr double kFarFromOthers = 8.0;      // ln: covariances this far are evaluated only once
constexpr int kRounds = 2;                  // repetitions if the sum at the most likely covariance changes
constexpr double kNearBest = 3.0;           // ln: covariances this near represent all in the search for other modes
constexpr double kLikely = 0.05;            // P of a relevant identity
constexpr double kBetterOptimum = 0.05;     // ln
constexpr double kAlone = 0.9;              // P of an identity in its single effect; excluding it gives another mode

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

  Posterior run(const std::vector<Covariance>& grid, bool is_given) {
    std::vector<WeightedAscent> found;
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<std::size_t> start = likeliest_set(searched_.best.ascent);
      found = ascended_everywhere(grid, is_given);
      if (likeliest_set(found.front().ascent) == start) break;
      searched_.best = found.front();
    }
    take_better_optimum(found);
    leave_out_far(found);
    add_modes(found);
    return averaged(std::move(found));
  }

 private:
  const Identities& identities() const { return searched_.identities; }

  WeightedAscent found_at(const Covariance& covariance, double background) const {
    WeightedAscent found{point_at(problem_, covariance), background, {}, kLogZero, {}};
    found.ascent.effects = searched_.best.ascent.effects;
    return found;
  }

  std::vector<WeightedAscent> found_at_all(const std::vector<Covariance>& covariances) const {
    std::vector<WeightedAscent> found;
    found.reserve(covariances.size());
    for (const Covariance& one : covariances) found.push_back(found_at(one, 0.0));
    return found;
  }

  // What carries weight where the readings are likeliest so far.
  Identities likely_identities() const {
    std::vector<std::size_t> likely;
    const std::vector<SingleEffect>& effects = searched_.best.ascent.effects;
    for (std::size_t i = 0; i < identities().log_prior.size(); ++i) {
      if (std::any_of(effects.begin(), effects.end(), [&](const SingleEffect& one) { return one.p[i] > kLikely; }))
        likely.push_back(i);
    }
    return restricted(identities(), likely);
  }

  void ascend_at(WeightedAscent& one, const Identities& few) const {
    ColumnsAt at(problem_, few, searched_.variant, one.point, background_of(problem_, one.background));
    const AscentOptions options = ascent_options(problem_, few, largest_);
    one.ascent = ascended(at, few, options, one.ascent);
    one.log_weight = one.ascent.bound + one.point.covariance.log_prior;
    if (!(one.background > 0.0)) return;
    Eigen::VectorXd line = at.curve_of({}).line;
    for (const SingleEffect& effect : one.ascent.effects) line += at.curve_of(effect.mean).line;
    one.shares = at.background_shares(line);
  }

  void scan(std::vector<WeightedAscent>& found, std::size_t first, const Identities& few) const {
    in_parallel(found.size() - first, [&](std::size_t g) {
      WeightedAscent trial = found[first + g];
      trial.ascent = {};
      ascend_at(trial, few);
      found[first + g].log_weight = trial.log_weight;
    });
  }

  // With few identities at all covariances, and between those about the likeliest; with all of them at those that are
  // likely.
  void ascend(std::vector<WeightedAscent>& found, bool between) {
    if (found.empty()) return;
    const Identities few = likely_identities();
    scan(found, 0, few);
    sort_by_weight(found);
    if (between) {
      const std::size_t first = found.size();
      for (const Covariance& one : noises_about(found.front().point.covariance, problem_.time_s))
        found.push_back(found_at(one, 0.0));
      scan(found, first, few);
      sort_by_weight(found);
    }
    const double likely = found.front().log_weight - kFarFromOthers;
    std::erase_if(found, [&](const WeightedAscent& one) { return one.log_weight < likely; });
    in_parallel(found.size(), [&](std::size_t g) { ascend_at(found[g], identities()); });
    sort_by_weight(found);
    if (found.front().log_weight > searched_.best.log_weight) searched_.best = found.front();
  }

  // From the best sum so far.
  std::vector<WeightedAscent> ascended_everywhere(const std::vector<Covariance>& grid, bool is_given) {
    std::vector<WeightedAscent> found = found_at_all(grid);
    ascend(found, !is_given);
    if (!is_given && problem_.model.level == Level::series) add_more(found, grid);
    return found;
  }

  struct Noises {
    std::vector<Covariance> likeliest;
    double log_represented = 0.0;  // ln of what these few stand for, over what they weigh themselves
  };

  static Noises likeliest_noises(const std::vector<WeightedAscent>& sorted) {
    Noises result;
    for (std::size_t g = 0; g < std::min(kNoisesWithMore, sorted.size()); ++g)
      result.likeliest.push_back(sorted[g].point.covariance);
    result.log_represented = log_weight_of(sorted, sorted.size()) - log_weight_of(sorted, kNoisesWithMore);
    return result;
  }

  std::vector<WeightedAscent> scanned(const std::vector<Covariance>& covariances, const Identities& few) const {
    std::vector<WeightedAscent> found = found_at_all(covariances);
    scan(found, 0, few);
    sort_by_weight(found);
    return found;
  }

  // Noise alone absorbs a slow curve, and differs from the noise with a discrepancy. All noises are therefore evaluated
  // with the most likely discrepancy of the most likely noise.
  Noises noises_with_discrepancy(const std::vector<Covariance>& grid, const Covariance& alone) const {
    const Identities few = likely_identities();
    const std::vector<WeightedAscent> first = scanned(with_discrepancy(alone, problem_.time_s), few);
    if (first.empty()) return {};
    std::vector<Covariance> with_slow;
    for (const Covariance& noise : grid) {
      for (const Covariance& one : with_discrepancy(noise, problem_.time_s)) {
        if (one.slow_time_s == first.front().point.covariance.slow_time_s) with_slow.push_back(one);
      }
    }
    std::vector<WeightedAscent> noises;  // of each what its discrepancies weigh together
    for (WeightedAscent& one : scanned(with_slow, few)) {
      Covariance& noise = one.point.covariance;
      noise.slow = noise.slow_time_s = 0.0;
      noise.log_prior = grid.front().log_prior;
      const auto known = std::find_if(noises.begin(), noises.end(),
                                      [&](const WeightedAscent& other) { return other.point.covariance == noise; });
      if (known == noises.end()) {
        noises.push_back(std::move(one));
      } else {
        known->log_weight = log_sum(std::vector{known->log_weight, one.log_weight});
      }
    }
    sort_by_weight(noises);
    return likeliest_noises(noises);
  }

  // The likeliest noises with a discrepancy, and with a background.
  void add_more(std::vector<WeightedAscent>& found, const std::vector<Covariance>& grid) {
    const bool has_inputs = problem_.library.families.size() > problem_.effects;
    std::vector<WeightedAscent> more;
    const Noises alone = likeliest_noises(found);
    const Noises with_slow = noises_with_discrepancy(grid, alone.likeliest.front());
    for (const Covariance& noise : with_slow.likeliest) {
      for (Covariance one : with_discrepancy(noise, problem_.time_s)) {
        one.log_prior += std::log(kPriorOfDiscrepancy) + with_slow.log_represented;
        more.push_back(found_at(one, 0.0));
      }
    }
    for (const Covariance& noise : alone.likeliest) {
      for (const double d : kBackgrounds) {
        if (!has_inputs) continue;
        Covariance one = noise;
        one.log_prior +=
            std::log((1.0 - kPriorOfDiscrepancy) * kPriorOfBackground / static_cast<double>(kBackgrounds.size())) +
            alone.log_represented;
        more.push_back(found_at(one, d));
      }
    }
    const double rest = std::log((1.0 - kPriorOfDiscrepancy) * (has_inputs ? 1.0 - kPriorOfBackground : 1.0));
    for (WeightedAscent& one : found) {
      one.point.covariance.log_prior += rest;
      one.log_weight += rest;
    }
    ascend(more, false);
    std::move(more.begin(), more.end(), std::back_inserter(found));
    sort_by_weight(found);
  }

  // A better optimum at the likeliest covariance is one everywhere.
  void take_better_optimum(std::vector<WeightedAscent>& found) {
    const ColumnsAt at(problem_, identities(), searched_.variant, found.front().point,
                       background_of(problem_, found.front().background));
    const Ascent best =
        rearranged(at, identities(), ascent_options(problem_, identities(), largest_), found.front().ascent);
    if (!(best.bound > found.front().ascent.bound + kBetterOptimum)) return;
    const double far = found.front().log_weight - 2.0 * kFarFromBest;
    std::erase_if(found, [&](const WeightedAscent& one) { return one.log_weight < far; });
    for (WeightedAscent& one : found) one.ascent.effects = best.effects;
    ascend(found, false);
  }

  static void leave_out_far(std::vector<WeightedAscent>& found) {
    const double far = found.front().log_weight - kFarFromBest;
    std::erase_if(found, [&](const WeightedAscent& one) { return one.log_weight < far; });
  }

  // Coordinate ascent finds one mode. Other modes have weight too: an identity that is certain in this mode may be
  // absent in another one.
  void add_modes(std::vector<WeightedAscent>& found) {
    const double near = found.front().log_weight - kNearBest;
    const auto count = static_cast<std::size_t>(
        std::count_if(found.begin(), found.end(), [&](const WeightedAscent& one) { return one.log_weight >= near; }));
    const double represented = log_weight_of(found, found.size()) - log_weight_of(found, count);
    const std::vector<SingleEffect> best = found.front().ascent.effects;
    for (const Mode& mode : searched_.modes) {
      const auto is_it = [&](const SingleEffect& one) { return one.p[mode.without] >= kAlone; };
      if (std::none_of(best.begin(), best.end(), is_it)) continue;
      const std::size_t first = found.size();
      for (std::size_t g = 0; g < count; ++g) found.push_back(found[g]);
      in_parallel(count, [&](std::size_t g) {
        WeightedAscent& one = found[first + g];
        ColumnsAt at(problem_, identities(), searched_.variant, one.point, background_of(problem_, one.background));
        one.ascent =
            ascended_from(at, identities(), ascent_options(problem_, identities(), largest_, mode.without), mode.set);
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
    result.background.assign(identities().families, 0.0);
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
      for (const auto& [family, share] : found[g].shares) result.background[family] += weight[g] * share;
      if (!slow && !(found[g].background > 0.0)) result.nothing += weight[g] * none;
    }
    const auto families = static_cast<std::ptrdiff_t>(identities().families);
    result.family.assign(p.begin(), p.begin() + families);
    result.own.assign(p.begin() + families, p.end());
    result.variants.push_back(std::move(searched_.variant));
    const Ascent likeliest = std::move(found.front().ascent);
    for (WeightedAscent& one : found) result.points.push_back(std::move(one.point));
    add_sets(problem_, identities(), likeliest, result);
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
  const bool is_given = !problem.covariances.empty();
  const std::vector<Covariance> grid = is_given ? problem.covariances : noise_grid(problem.time_s);
  SearchResult best = search_result(problem, largest, grid);
  Posterior result = Average(problem, largest, std::move(best)).run(grid, is_given);
  if (so_far) so_far(result.family);
  return result;
}

}  // namespace ballbar
