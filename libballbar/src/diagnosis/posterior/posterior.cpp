#include "diagnosis/posterior/posterior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/refined.hpp"
#include "diagnosis/posterior/ascent.hpp"
#include "diagnosis/posterior/beside.hpp"
#include "diagnosis/posterior/sets.hpp"

namespace ballbar {
namespace {

constexpr double kPriorOfBackground = 0.03;
constexpr std::array<double, 2> kBackgrounds{6.0, 20.0};  // d of all of it together
constexpr std::size_t kNoisesBesideMore = 3;  // the likeliest, with a discrepancy or a background beside them
constexpr double kFarFromBest = 7.0;          // ln: covariances this far are left out
constexpr double kFarFromOthers = 8.0;        // ln: covariances this far are not looked at twice
constexpr double kLikely = 0.05;              // P of an identity that carries weight
constexpr int kRelinearised = 3;              // times
constexpr double kSameModel = 0.02;           // of a shape's reach
constexpr std::size_t kPilots = 2;            // covariances at which the model is looked for
constexpr double kOtherStart = 0.3;
constexpr std::size_t kSharpenedRivals = 4;  // of a single effect, whose shapes are sought between those of the grid
constexpr double kSameBound = 0.01;          // ln: two ascents that differ by less are one
constexpr double kFarRival = 7.0;            // ln: one so much weaker than the strongest is not sought

// A covariance with what the ascent finds at it.
struct Found {
  Point point{{}, {{}, {}, {}}};
  double background = 0.0;
  Ascent ascent;
  double log_weight = kLogZero;
  std::vector<std::pair<std::size_t, double>> shares;  // of the background, by family
};

AscentOptions options_of(const Problem& problem, const Identities& identities, std::size_t largest) {
  AscentOptions options;
  SinglePrior prior{std::log(kPriorOfNone), identities.log_prior};
  for (double& one : prior.log_identity) one += std::log1p(-kPriorOfNone);
  options.priors = {std::move(prior)};
  options.largest = largest;
  options.known = problem.known;
  options.least_variance = least_variance_of(problem);
  return options;
}

// A block of many columns can stand in for several effects: the ascent begins with it, and without it.
Ascent best_ascent(ColumnsAt& at, const Problem& problem, const Identities& identities, const AscentOptions& options,
                   const Ascent& start) {
  Ascent best = ascended(at, identities, options, start);
  if (identities.families == problem.effects) return best;
  AscentOptions of_effects = options;
  for (SinglePrior& prior : of_effects.priors) {
    for (std::size_t i = problem.effects; i < identities.families; ++i) prior.log_identity[i] = kLogZero;
  }
  Ascent other = ascended(at, identities, options, ascended(at, identities, of_effects));
  return other.bound > best.bound + kSameBound ? other : best;
}

class Search {
 public:
  Search(Problem& problem, std::size_t largest, const std::function<void(const std::vector<double>&)>& so_far)
      : problem_(problem), largest_(largest), so_far_(so_far) {}

  Posterior run() {
    std::vector<Covariance> grid = problem_.covariances;
    const bool is_given = !grid.empty();
    if (!is_given) grid = noise_grid(problem_.time_s);
    start(grid);

    for (int round = 0; round < kRelinearised; ++round) {
      if (!relinearise()) break;
    }

    std::vector<Found> found;
    found.reserve(grid.size());
    for (const Covariance& one : grid) found.push_back(found_at(one, 0.0));
    ascend(found, !is_given);
    if (!is_given && problem_.model.level == Level::series) add_more(found);

    return averaged(std::move(found));
  }

 private:
  // The likeliest covariances where a little of every input in every form stands for all effects.
  std::vector<Covariance> likeliest_of(const std::vector<Covariance>& grid, const Variant& variant,
                                       const Identities& none) const {
    std::vector<Found> found;
    found.reserve(grid.size());
    for (const Covariance& one : grid)
      found.push_back({point_at(problem_, one), kBackgrounds.back(), {}, kLogZero, {}});
    in_parallel(found.size(), [&](std::size_t g) {
      ColumnsAt at(problem_, none, variant, found[g].point, background_of(found[g].background));
      found[g].log_weight = ascended(at, none, options_of(problem_, none, 0)).bound + grid[g].log_prior;
    });
    sort(found);
    std::vector<Covariance> likeliest;
    for (std::size_t g = 0; g < std::min(kPilots, found.size()); ++g) likeliest.push_back(found[g].point.covariance);
    return likeliest;
  }

  // The model about its fit by least squares, and about what noise with a memory makes of it.
  void start(const std::vector<Covariance>& grid) {
    const std::vector<double> fit = fitted_parameters(problem_);
    std::vector<Variant> starts{variant_at(problem_, 0, fit)};
    pilots_ = likeliest_of(grid, starts.front(), restricted(identities_of(problem_, starts.front()), {}));
    const auto add = [&](const Point& point, std::vector<double> from, int rounds) {
      const Refined there = refined(*problem_.base_model, std::move(from), {}, starts.front().times, point.filter,
                                    problem_.known, rounds);
      if (std::all_of(starts.begin(), starts.end(), [&](const Variant& other) {
            return is_elsewhere(problem_, other, there.parameters, kOtherStart);
          }))
        starts.push_back(variant_at(problem_, 0, there.parameters));
    };
    const std::vector<double> usual = with_times(problem_, fit, kUsualTime_s);
    for (const Covariance& one : pilots_) {
      const Point point = point_at(problem_, one);
      for (const std::vector<double>& from : {fit, usual}) add(point, from, 12);
    }
    // A missing effect pulls the fitted times away: once from usual ones, as they are.
    add(point_at(problem_, pilots_.front()), usual, 0);
    for (OwnParameter& own : problem_.own) starts.push_back(beside_own(own, fit, starts.front().times));
    for (Variant& variant : starts) take_if_better(std::move(variant));
  }

  // The model where a held value is another one, which is remembered; of the line it is held.
  Variant beside_own(OwnParameter& own, std::vector<double> from, const Eigen::MatrixXd& times) const {
    const Refined refined_there = refined(*problem_.base_model, std::move(from), {own.parameter}, times,
                                          point_at(problem_, pilots_.front()).filter, problem_.known, 12);
    std::vector<double> parameters = refined_there.parameters;
    own.fitted.push_back(parameters[own.parameter]);
    parameters[own.parameter] = own.held;
    return variant_at(problem_, 0, std::move(parameters));
  }

  // At the pilots; true: the bound is better than the best so far.
  bool take_if_better(Variant variant) {
    Identities identities = identities_of(problem_, variant);
    std::vector<Found> found(pilots_.size());
    in_parallel(pilots_.size(), [&](std::size_t g) {
      found[g].point = point_at(problem_, pilots_[g]);
      ColumnsAt at(problem_, identities, variant, found[g].point, {});
      const AscentOptions options = options_of(problem_, identities, largest_);
      found[g].ascent = best_ascent(at, problem_, identities, options, {});
      found[g].log_weight = found[g].ascent.bound + pilots_[g].log_prior;
    });
    auto best = std::max_element(found.begin(), found.end(),
                                 [](const Found& a, const Found& b) { return a.log_weight < b.log_weight; });
    const bool better = best->log_weight > best_.log_weight + 0.01;
    if (!better && variant_) return false;
    variant_ = std::move(variant);
    identities_ = std::move(identities);
    best_ = std::move(*best);
    return true;
  }

  // Of one single effect the identities of the catalogue, the strongest first. Where an input of any form is stronger
  // the shapes of all are too coarse to tell which is near.
  std::vector<std::size_t> effects_of(const SingleEffect& one) const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < problem_.effects; ++i) {
      if (one.strength[i] > kLogZero) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return one.strength[a] > one.strength[b]; });
    const auto likeliest = static_cast<std::size_t>(std::max_element(one.p.begin(), one.p.end()) - one.p.begin());
    const bool is_form = likeliest >= problem_.effects && !identities_.is_own(likeliest);
    while (order.size() > 1 && !is_form && one.strength[order.back()] < one.strength[order.front()] - kFarRival)
      order.pop_back();
    return order;
  }

  // The model about where the best set of effects has its parameters, the shapes of the set and of its rivals at their
  // likeliest.
  bool relinearise() {
    std::vector<std::size_t> signatures;
    std::vector<std::pair<std::size_t, std::vector<std::size_t>>> rivals;  // by their place in the set
    for (const SingleEffect& one : best_.ascent.effects) {
      if (one.p_any() < 0.5) continue;
      const std::vector<std::size_t> order = effects_of(one);
      if (order.empty()) continue;
      std::vector<std::size_t> shapes;
      for (std::size_t k = 0; k < std::min(order.size(), kSharpenedRivals); ++k) {
        if (const auto shape = signature_of(problem_, identities_, one.likeliest[order[k]])) shapes.push_back(*shape);
      }
      if (shapes.empty()) continue;
      if (shapes.size() > 1) rivals.emplace_back(signatures.size(), std::vector(shapes.begin() + 1, shapes.end()));
      signatures.push_back(shapes.front());
    }
    const std::size_t before = problem_.library.signatures.size();
    const std::optional<std::size_t> own = likeliest_own();
    if (own) return relinearise_own(problem_.own[*own], *own, signatures);
    Beside beside = parameters_beside(problem_, *variant_, signatures, best_.point);
    if (!signatures.empty()) beside = sharpened(problem_, *variant_, std::move(beside), best_.point);
    std::vector<Beside> all{beside};
    for (const auto& [place, others] : rivals) {
      for (const std::size_t rival : others) {
        Beside other{beside.signatures, beside.parameters, {}};
        other.signatures[place] = rival;
        all.push_back(sharpened(problem_, *variant_, std::move(other), best_.point));
      }
    }
    const bool is_new = problem_.library.signatures.size() > before;
    if (!is_new && !is_elsewhere(problem_, *variant_, beside.parameters, kSameModel)) return false;
    return take_if_better(likeliest_beside(all));
  }

  // The model beside one of these sets. What logs leave open of the times of its inputs is that of its own effects, so
  // that a rival is likelier beside itself than beside another.
  Variant likeliest_beside(const std::vector<Beside>& all) const {
    std::set<std::size_t> few;
    for (const Beside& one : all) {
      for (const std::size_t i : one.signatures) few.insert(problem_.library.signatures[i].family);
    }
    std::vector<Variant> variants;
    variants.reserve(all.size());
    for (const Beside& one : all)
      variants.push_back(variant_at(problem_, 0, one.parameters, times_beside(problem_, one)));
    if (variants.size() == 1) return std::move(variants.front());
    std::vector<double> log_weight(variants.size());
    in_parallel(variants.size(), [&](std::size_t v) {
      const Identities identities = restricted(identities_of(problem_, variants[v]), {few.begin(), few.end()});
      ColumnsAt at(problem_, identities, variants[v], best_.point, {});
      log_weight[v] = ascended(at, identities, options_of(problem_, identities, largest_)).bound;
    });
    return std::move(variants[static_cast<std::size_t>(std::max_element(log_weight.begin(), log_weight.end()) -
                                                       log_weight.begin())]);
  }

  // The held value that is likelier another one than not.
  std::optional<std::size_t> likeliest_own() const {
    for (const SingleEffect& one : best_.ascent.effects) {
      const auto i = static_cast<std::size_t>(std::max_element(one.p.begin(), one.p.end()) - one.p.begin());
      if (one.p_any() >= 0.5 && identities_.is_own(i)) return i - identities_.families;
    }
    return std::nullopt;
  }

  bool relinearise_own(OwnParameter& own, std::size_t place, const std::vector<std::size_t>& signatures) {
    std::vector<double> parameters = variant_->parameters;
    parameters[own.parameter] = own.fitted.back();
    const Variant free = variant_at(problem_, place + 1, std::move(parameters));
    Beside beside = parameters_beside(problem_, free, signatures, best_.point);
    const double value = beside.parameters[own.parameter];
    const bool is_new = std::abs(value - own.fitted.back()) > kSameModel * std::abs(own.held);
    if (is_new) own.fitted.push_back(value);
    beside.parameters[own.parameter] = own.held;
    if (!is_new && !is_elsewhere(problem_, *variant_, beside.parameters, kSameModel)) return false;
    return take_if_better(variant_at(problem_, 0, std::move(beside.parameters)));
  }

  Found found_at(const Covariance& covariance, double background) const {
    Found found{point_at(problem_, covariance), background, {}, kLogZero, {}};
    found.ascent.effects = best_.ascent.effects;
    return found;
  }

  DenseBackground background_of(double d) const {
    DenseBackground background;
    background.d = d;
    if (!(d > 0.0)) return background;
    std::vector<Eigen::Index> columns;
    for (std::size_t f = problem_.effects; f < problem_.library.families.size(); ++f) {
      const Signature& one = problem_.library.signatures[problem_.library.families[f].first];
      for (Eigen::Index k = 0; k < one.width; k += 3) {
        columns.push_back(one.first + k);
        background.family.push_back(f);
      }
    }
    background.columns = problem_.signatures(Eigen::all, columns);
    return background;
  }

  // What carries weight where the readings are likeliest so far.
  Identities likely_identities() const {
    std::vector<std::size_t> likely;
    for (std::size_t i = 0; i < identities_.log_prior.size(); ++i) {
      if (std::any_of(best_.ascent.effects.begin(), best_.ascent.effects.end(),
                      [&](const SingleEffect& one) { return one.p[i] > kLikely; }))
        likely.push_back(i);
    }
    return restricted(identities_, likely);
  }

  void ascend_at(Found& one, const Identities& identities, bool from_both) const {
    ColumnsAt at(problem_, identities, *variant_, one.point, background_of(one.background));
    const AscentOptions options = options_of(problem_, identities, largest_);
    one.ascent = from_both ? best_ascent(at, problem_, identities, options, one.ascent)
                           : ascended(at, identities, options, one.ascent);
    one.log_weight = one.ascent.bound + one.point.covariance.log_prior;
    if (!(one.background > 0.0)) return;
    at.settle(one.ascent.variance);  // the last ascent may have been another one
    Eigen::VectorXd line = at.curve_of({}).line;
    for (const SingleEffect& effect : one.ascent.effects) line += at.curve_of(effect.mean).line;
    one.shares = at.background_shares(line);
  }

  void scan(std::vector<Found>& found, std::size_t first, const Identities& few) const {
    in_parallel(found.size() - first, [&](std::size_t g) {
      Found trial = found[first + g];
      trial.ascent = {};
      ascend_at(trial, few, false);
      found[first + g].log_weight = trial.log_weight;
    });
  }

  // With few identities at all covariances, and between those about the likeliest; with all of them at those that are
  // likely.
  void ascend(std::vector<Found>& found, bool between) {
    if (found.empty()) return;
    const Identities few = likely_identities();
    scan(found, 0, few);
    sort(found);
    if (between) {
      const std::size_t first = found.size();
      for (const Covariance& one : noises_about(found.front().point.covariance, problem_.time_s))
        found.push_back(found_at(one, 0.0));
      scan(found, first, few);
      sort(found);
    }
    const double likely = found.front().log_weight - kFarFromOthers;
    const auto end =
        std::find_if(found.begin(), found.end(), [&](const Found& one) { return one.log_weight < likely; });
    found.erase(end, found.end());
    in_parallel(found.size(), [&](std::size_t g) { ascend_at(found[g], identities_, true); });
    sort(found);
    if (found.front().log_weight > best_.log_weight) best_ = found.front();
  }

  static void sort(std::vector<Found>& found) {
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.log_weight > b.log_weight; });
  }

  // ln of what the first few weigh together.
  static double log_weight_of(const std::vector<Found>& found, std::size_t count) {
    std::vector<double> weights;
    for (std::size_t g = 0; g < std::min(count, found.size()); ++g) weights.push_back(found[g].log_weight);
    return log_sum(weights);
  }

  // The likeliest noises with a discrepancy, and with a background.
  void add_more(std::vector<Found>& found) {
    const bool has_inputs = problem_.library.families.size() > problem_.effects;
    std::vector<Found> more;
    // These few stand for all noises.
    const double represented = log_weight_of(found, found.size()) - log_weight_of(found, kNoisesBesideMore);
    for (std::size_t g = 0; g < std::min(kNoisesBesideMore, found.size()); ++g) {
      const Covariance& noise = found[g].point.covariance;
      for (Covariance one : with_discrepancy(noise, problem_.time_s)) {
        one.log_prior += std::log(kPriorOfDiscrepancy) + represented;
        more.push_back(found_at(one, 0.0));
      }
      for (const double d : kBackgrounds) {
        if (!has_inputs) continue;
        Covariance one = noise;
        one.log_prior +=
            std::log((1.0 - kPriorOfDiscrepancy) * kPriorOfBackground / static_cast<double>(kBackgrounds.size())) +
            represented;
        more.push_back(found_at(one, d));
      }
    }
    const double rest = std::log((1.0 - kPriorOfDiscrepancy) * (has_inputs ? 1.0 - kPriorOfBackground : 1.0));
    for (Found& one : found) {
      one.point.covariance.log_prior += rest;
      one.log_weight += rest;
    }
    ascend(more, false);
    std::move(more.begin(), more.end(), std::back_inserter(found));
    sort(found);
  }

  // Puts single effects in the order of others that they are most alike to: the order of a sum is of no account.
  static void align(const std::vector<SingleEffect>& to, std::size_t identities, std::vector<SingleEffect>& effects) {
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

  Posterior averaged(std::vector<Found> found) {
    // A better optimum at the likeliest covariance is one everywhere.
    {
      ColumnsAt at(problem_, identities_, *variant_, found.front().point, background_of(found.front().background));
      const AscentOptions options = options_of(problem_, identities_, largest_);
      Ascent best = rearranged(at, identities_, options, found.front().ascent);
      if (best.bound > found.front().ascent.bound + 0.05) {
        for (Found& one : found) {
          if (one.log_weight > found.front().log_weight - 2.0 * kFarFromBest) one.ascent.effects = best.effects;
        }
        std::erase_if(found,
                      [&](const Found& one) { return one.log_weight < found.front().log_weight - 2.0 * kFarFromBest; });
        ascend(found, false);
      }
    }
    std::erase_if(found, [&](const Found& one) { return one.log_weight < found.front().log_weight - kFarFromBest; });
    Posterior result;
    std::vector<double>& weight = result.weight;
    for (const Found& one : found) weight.push_back(std::exp(one.log_weight - found.front().log_weight));
    const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (double& one : weight) one /= total;
    const std::size_t count = identities_.log_prior.size();
    for (std::size_t g = 1; g < found.size(); ++g) align(found.front().ascent.effects, count, found[g].ascent.effects);
    std::size_t effects = 0;
    for (const Found& one : found) effects = std::max(effects, one.ascent.effects.size());
    result.effects.assign(effects, {std::vector<double>(count, 0.0)});
    std::vector<double> p(count, 0.0);
    result.nothing = result.none = result.discrepancy = 0.0;
    result.background.assign(identities_.families, 0.0);
    for (std::size_t g = 0; g < found.size(); ++g) {
      double none = 1.0;
      std::vector<double> without(count, 1.0);
      for (std::size_t l = 0; l < found[g].ascent.effects.size(); ++l) {
        const SingleEffect& one = found[g].ascent.effects[l];
        for (std::size_t i = 0; i < count; ++i) {
          result.effects[l].p[i] += weight[g] * one.p[i];
          without[i] *= std::max(0.0, 1.0 - one.p[i]);
        }
        none *= std::max(0.0, 1.0 - one.p_any());
      }
      for (std::size_t i = 0; i < count; ++i) p[i] += weight[g] * (1.0 - without[i]);
      const bool slow = found[g].point.covariance.slow > 0.0;
      result.none += weight[g] * none;
      if (slow) result.discrepancy += weight[g];
      for (const auto& [family, share] : found[g].shares) result.background[family] += weight[g] * share;
      if (!slow && !(found[g].background > 0.0)) result.nothing += weight[g] * none;
    }
    const auto families = static_cast<std::ptrdiff_t>(identities_.families);
    result.family.assign(p.begin(), p.begin() + families);
    result.own.assign(p.begin() + families, p.end());
    if (so_far_) so_far_(result.family);
    result.variants.push_back(std::move(*variant_));
    const Ascent likeliest = std::move(found.front().ascent);
    for (Found& one : found) result.points.push_back(std::move(one.point));
    add_sets(problem_, identities_, likeliest, result);
    return result;
  }

  static constexpr double kUsualTime_s = 1500.0;  // of a model's times, where their fit has run away

  Problem& problem_;
  std::size_t largest_;
  const std::function<void(const std::vector<double>&)>& so_far_;
  std::vector<Covariance> pilots_;
  std::optional<Variant> variant_;
  Identities identities_;
  Found best_;
};

}  // namespace

double SinglePosterior::p_any() const { return std::accumulate(p.begin(), p.end(), 0.0); }

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior posterior_of(Problem& problem, std::size_t largest,
                       const std::function<void(const std::vector<double>&)>& so_far) {
  return Search(problem, largest, so_far).run();
}

}  // namespace ballbar
