#include "diagnosis/posterior/search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/evidence/refined.hpp"

namespace ballbar {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

struct Key {
  std::size_t own = 0;
  std::vector<std::size_t> families;
  auto operator<=>(const Key&) const = default;
};

// Evidence of one set at one point and variant.
struct Found {
  double log_weight = kNone;
  double most = kNone;
  std::vector<std::size_t> signatures;
};

// Sets at each point: of several variants of one kind the best counts.
struct Table {
  std::size_t points = 0;
  std::map<Key, std::vector<std::pair<Found, std::size_t>>> sets;  // at each point, with the variant

  void add(const Key& key, std::size_t point, std::size_t variant, Found found) {
    auto& at = sets[key];
    at.resize(points);
    if (found.log_weight > at[point].first.log_weight) at[point] = {std::move(found), variant};
  }
};

double prior_of_size(std::size_t size) { return std::log(kPriorOfSize[std::min(size, kPriorOfSize.size() - 1)]); }

class Search {
 public:
  Search(Problem& problem, std::size_t largest, std::vector<std::size_t> wanted)
      : problem_(problem), largest_(largest), wanted_{0, std::move(wanted)} {
    std::sort(wanted_.families.begin(), wanted_.families.end());
    const auto& signatures = problem.library.signatures;
    for (std::size_t f = 0; f < problem.effects; ++f) {
      const Family& family = problem.library.families[f];
      const std::size_t most = std::clamp<std::size_t>(kThinColumns / problem.effects, 1, kThinShapes);
      const std::size_t stride = 1 + (family.count - 1) / most;
      for (std::size_t i = family.first + stride / 2; i < family.first + family.count; i += stride) thin_.push_back(i);
    }
    all_.resize(signatures.size());
    std::iota(all_.begin(), all_.end(), std::size_t{0});
  }

  Posterior run() {
    const std::vector<Covariance> grid = covariance_grid(problem_.time_s, problem_.model.level == Level::series);
    std::vector<Point> points;
    points.reserve(grid.size());
    for (const Covariance& one : grid)
      points.push_back({one, CovarianceFilter(one, problem_.time_s, problem_.relative_variance)});
    result_.points = std::move(points);
    result_.variants.push_back(variant_at(0, parameters_of_fit(), nullptr));
    judge_noise();
    screen();
    table_.points = result_.points.size();
    // The model about where it is most likely at the likeliest covariance, then about where the best sets have it.
    singles(0);
    pairs(0);
    weigh_wanted(0);
    add_own();
    for (int round = 0; round < kRelinearised; ++round) {
      if (!relinearise()) break;
    }
    sum_up();
    return std::move(result_);
  }

 private:
  std::vector<double> parameters_of_fit() const {
    std::vector<double> parameters;
    for (const FittedParameter& one : problem_.base.parameters) parameters.push_back(one.value);
    parameters.front() -= problem_.centre_um;
    return parameters;
  }

  Variant variant_at(std::size_t own, std::vector<double> parameters, const Eigen::MatrixXd* times) const {
    Variant variant;
    variant.own = own;
    variant.times = times != nullptr ? *times : problem_.base_model->times_at(parameters);
    const BaseColumns columns = problem_.base_model->at(parameters, free_of(own));
    variant.pool = pool_of(columns, variant.times);
    variant.line = line_of(columns, variant.times.cols(), 0);
    variant.parameters = std::move(parameters);
    return variant;
  }

  std::vector<std::size_t> free_of(std::size_t own) const {
    if (own == 0) return {};
    return {problem_.own[own - 1].parameter};
  }

  double log_prior(const Key& key) const { return log_prior_of_set(problem_, key.families, key.own); }

  RowMajorMatrix columns_of(const std::vector<std::size_t>& chosen) const {
    RowMajorMatrix columns(problem_.signatures.rows(), width_of(chosen));
    Eigen::Index at = 0;
    for (const std::size_t i : chosen) {
      const Signature& one = problem_.library.signatures[i];
      columns.middleCols(at, one.width) = problem_.signatures.middleCols(one.first, one.width);
      at += one.width;
    }
    return columns;
  }

  Eigen::Index width_of(const std::vector<std::size_t>& chosen) const {
    Eigen::Index width = 0;
    for (const std::size_t i : chosen) width += problem_.library.signatures[i].width;
    return width;
  }

  struct Beside {
    std::vector<double> parameters;
    Eigen::VectorXd coefficients;  // of the signatures' columns
  };

  // All columns of some signatures at one point: what is left of them beside the line.
  struct Seen {
    Solved base;
    Eigen::VectorXd whole;            // squares before
    std::vector<Eigen::Index> first;  // of each chosen signature
    Eigen::MatrixXd left;             // products; empty unless asked for
  };

  Seen seen_at(const Point& point, const Variant& variant, const RowMajorMatrix& columns,
               const std::vector<std::size_t>& chosen, bool with_products) const {
    Seen seen;
    const Gram gram = gram_of(point.filter, variant.pool, columns);
    seen.base = solved(gram, variant.line, problem_.known);
    seen.whole = gram.squares;
    Eigen::Index at = 0;
    for (const std::size_t i : chosen) {
      seen.first.push_back(at);
      at += problem_.library.signatures[i].width;
    }
    if (with_products) {
      std::vector<Eigen::Index> every(static_cast<std::size_t>(columns.cols()));
      std::iota(every.begin(), every.end(), Eigen::Index{0});
      seen.left = products_of(point.filter, columns, every);
      seen.left.noalias() -= seen.base.cross.transpose() * seen.base.cross;
    }
    return seen;
  }

  bool survives(const Seen& seen, Eigen::Index column) const {
    return seen.base.left[column] > kSurvivingShare * seen.whole[column];
  }

  // Of one signature with one gain or several.
  double evidence_of(const Seen& seen, const RowMajorMatrix& columns, const Point& point, std::size_t place,
                     std::size_t signature) const {
    const Eigen::Index first = seen.first[place], width = problem_.library.signatures[signature].width;
    if (!survives(seen, first)) return kNone;
    if (width == 1) return log_evidence(seen.base, seen.base.left[first], seen.base.along[first]);
    Eigen::MatrixXd left;
    if (seen.left.size() > 0) {
      left = seen.left.block(first, first, width, width);
    } else {
      std::vector<Eigen::Index> own(static_cast<std::size_t>(width));
      std::iota(own.begin(), own.end(), first);
      left = products_of(point.filter, columns, own);
      const auto cross = seen.base.cross.middleCols(first, width);
      left -= cross.transpose() * cross;
    }
    const Eigen::VectorXd along = seen.base.along.segment(first, width);
    return problem_.library.signatures[signature].family < problem_.effects
               ? log_evidence(seen.base, left, along, 1.0 / static_cast<double>(width))
               : log_evidence_of_forms(seen.base, left, along);
  }

  // The noise is what the richest model leaves: every input in any form. A poor one's noise holds what it lacks.
  void judge_noise() {
    std::vector<std::size_t> forms;
    for (std::size_t f = problem_.effects; f < problem_.library.families.size(); ++f)
      forms.push_back(problem_.library.families[f].first);
    if (forms.empty() || result_.points.size() < 2) return;
    const RowMajorMatrix columns = columns_of(forms);
    const double share = 1.0 / static_cast<double>(problem_.library.signatures[forms.front()].width);
    std::vector<double> evidence(result_.points.size());
    std::vector<std::size_t> first(evidence.size());  // with the same noise, whatever is slow
    for (std::size_t g = 0; g < first.size(); ++g) {
      first[g] = g;
      const Covariance& one = result_.points[g].covariance;
      for (std::size_t k = 0; k < g && first[g] == g; ++k) {
        const Covariance& other = result_.points[k].covariance;
        if (other.white == one.white && other.time_s == one.time_s) first[g] = k;
      }
    }
    in_parallel(evidence.size(), [&](std::size_t g) {
      if (first[g] != g) return;
      Covariance noise = result_.points[g].covariance;
      noise.slow = 0.0;
      const Point point{noise, result_.points[g].covariance.slow > 0.0
                                   ? CovarianceFilter(noise, problem_.time_s, problem_.relative_variance)
                                   : result_.points[g].filter};
      const Seen seen = seen_at(point, result_.variants[0], columns, forms, true);
      evidence[g] = log_evidence(seen.base, seen.left, seen.base.along, share);
    });
    for (std::size_t g = 0; g < evidence.size(); ++g) evidence[g] = evidence[first[g]];
    for (const bool slow : {false, true}) {
      std::vector<double> of_these;
      for (std::size_t g = 0; g < evidence.size(); ++g) {
        if ((result_.points[g].covariance.slow > 0.0) == slow) of_these.push_back(kRichestNoise * evidence[g]);
      }
      if (of_these.empty()) continue;
      const double all = log_sum(of_these) - std::log(static_cast<double>(of_these.size()));
      for (std::size_t g = 0; g < evidence.size(); ++g) {
        if ((result_.points[g].covariance.slow > 0.0) != slow) continue;
        double& prior = result_.points[g].covariance.log_prior;
        prior = std::max(prior + kRichestNoise * evidence[g] - all, prior - 30.0);
      }
    }
  }

  // Covariances at which neither the model alone nor an effect makes the readings nearly as likely as another go.
  void screen() {
    const std::vector<std::size_t>& chosen = thin_;
    const RowMajorMatrix columns = columns_of(chosen);
    std::vector<double> most(result_.points.size(), kNone);
    std::vector<std::vector<double>> single(result_.points.size());
    in_parallel(result_.points.size(), [&](std::size_t g) {
      const Point& point = result_.points[g];
      const Seen seen = seen_at(point, result_.variants[0], columns, chosen, false);
      double best = prior_of_size(0) + log_evidence(seen.base);
      single[g].resize(chosen.size(), kNone);
      for (std::size_t k = 0; k < chosen.size(); ++k) {
        single[g][k] = evidence_of(seen, columns, point, k, chosen[k]);
        best = std::max(best, single[g][k] + problem_.log_prior[family_of(chosen[k])] + prior_of_size(1));
      }
      most[g] = best + point.covariance.log_prior;
    });
    // The strongest few together with every other one: where two are missing the noise of one alone is too slow.
    std::vector<std::size_t> strongest;
    if (largest_ > 1 && !chosen.empty()) {
      std::vector<std::pair<double, std::size_t>> order;
      std::map<std::size_t, double> of_family;
      for (std::size_t k = 0; k < chosen.size(); ++k) {
        double sum = kNone;
        for (std::size_t g = 0; g < result_.points.size(); ++g)
          sum = std::max(sum, single[g][k] + result_.points[g].covariance.log_prior);
        order.emplace_back(sum, k);
      }
      std::sort(order.rbegin(), order.rend());
      std::vector<std::size_t> taken;
      for (const auto& [value, k] : order) {
        const std::size_t family = family_of(chosen[k]);
        if (std::find(taken.begin(), taken.end(), family) != taken.end()) continue;
        taken.push_back(family);
        strongest.push_back(chosen[k]);
        if (strongest.size() == kStrongest) break;
      }
      std::vector<std::size_t> few;
      for (std::size_t k = 0; k < chosen.size(); k += kThinnedFurther) few.push_back(chosen[k]);
      const RowMajorMatrix few_columns = columns_of(few);
      in_parallel(result_.points.size(), [&](std::size_t g) {
        const Point& point = result_.points[g];
        for (const std::size_t strong : strongest) {
          // In the model's place: a flat gain, its prior by hand.
          Variant with = result_.variants[0];
          const Signature& one = problem_.library.signatures[strong];
          const Eigen::Index p = with.pool.cols();
          with.pool.conservativeResize(Eigen::NoChange, p + one.width);
          with.pool.rightCols(one.width) = problem_.signatures.middleCols(one.first, one.width);
          for (Eigen::Index k = 0; k < one.width; ++k) {
            with.line.columns.push_back(p + k);
            with.line.is_free.push_back(1);
          }
          const Seen seen = seen_at(point, with, few_columns, few, false);
          const double alone = log_evidence(seen.base);
          const Solved& before = seen.base;
          // Flat to N(0, d^2 s^2): about ln |column| - ln d.
          const double price = 0.5 * std::log(std::max(1e-300, before.variance)) + 0.0;
          double best = alone;
          for (std::size_t k = 0; k < few.size(); ++k) {
            if (family_of(few[k]) == one.family || problem_.library.signatures[few[k]].width > 1) continue;
            if (!survives(seen, seen.first[k])) continue;
            best =
                std::max(best, log_evidence(seen.base, seen.base.left[seen.first[k]], seen.base.along[seen.first[k]]) +
                                   problem_.log_prior[family_of(few[k])]);
          }
          most[g] = std::max(most[g], best - price - 3.0 + problem_.log_prior[one.family] + prior_of_size(2) +
                                          point.covariance.log_prior);
        }
      });
    }
    const double top = *std::max_element(most.begin(), most.end());
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t g = 0; g < most.size(); ++g) {
      if (most[g] > top - kLikelyPoints) order.emplace_back(most[g], g);
    }
    std::sort(order.rbegin(), order.rend());
    if (order.size() > kMostPoints) order.resize(kMostPoints);
    std::vector<Point> kept;
    kept.reserve(order.size());
    for (const auto& [value, g] : order) kept.push_back(std::move(result_.points[g]));
    result_.points = std::move(kept);
  }

  std::size_t family_of(std::size_t signature) const { return problem_.library.signatures[signature].family; }

  // only: this family alone; nothing: all.
  void singles(std::size_t v, const std::vector<std::size_t>* only = nullptr) {
    const Variant& variant = result_.variants[v];
    std::vector<std::size_t> chosen, place(problem_.library.signatures.size());
    for (const std::size_t i : all_) {
      if (only != nullptr && std::find(only->begin(), only->end(), family_of(i)) == only->end()) continue;
      place[i] = chosen.size();
      chosen.push_back(i);
    }
    const RowMajorMatrix some = only != nullptr ? columns_of(chosen) : RowMajorMatrix();
    const RowMajorMatrix& columns = only != nullptr ? some : problem_.signatures;
    std::vector<std::vector<std::pair<Key, Found>>> found(result_.points.size());
    in_parallel(result_.points.size(), [&](std::size_t g) {
      const Point& point = result_.points[g];
      const Seen seen = seen_at(point, variant, columns, chosen, false);
      const Key none{variant.own, {}};
      const double alone = log_evidence(seen.base) + log_prior(none) + point.covariance.log_prior;
      found[g].push_back({none, {alone, alone, {}}});
      for (std::size_t f = 0; f < problem_.library.families.size(); ++f) {
        if (only != nullptr && std::find(only->begin(), only->end(), f) == only->end()) continue;
        const Family& family = problem_.library.families[f];
        const Key key{variant.own, {f}};
        const double prior = log_prior(key) + point.covariance.log_prior;
        Found one;
        std::vector<double> shapes;
        for (const std::size_t i : shapes_of(family)) {
          const double value = evidence_of(seen, columns, point, place[i], i);
          if (value == kNone) continue;
          shapes.push_back(value + prior + problem_.log_prior_of_shape[i]);
          if (shapes.back() > one.most) {
            one.most = shapes.back();
            one.signatures = {i};
          }
        }
        if (shapes.empty()) continue;
        one.log_weight = log_sum(shapes);
        found[g].push_back({key, std::move(one)});
      }
    });
    for (std::size_t g = 0; g < found.size(); ++g) {
      for (auto& [key, one] : found[g]) table_.add(key, g, v, std::move(one));
    }
  }

  // Points in the order of their best set so far that has `own`.
  std::vector<std::size_t> best_points(std::size_t own, std::size_t most) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t g = 0; g < result_.points.size(); ++g) order.emplace_back(kNone, g);
    for (const auto& [key, at] : table_.sets) {
      if (key.own != own) continue;
      for (std::size_t g = 0; g < at.size(); ++g) order[g].first = std::max(order[g].first, at[g].first.log_weight);
    }
    std::sort(order.rbegin(), order.rend());
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < std::min(most, order.size()); ++k) result.push_back(order[k].second);
    return result;
  }

  double weight_of(const Key& key) const {
    const auto at = table_.sets.find(key);
    if (at == table_.sets.end()) return kNone;
    std::vector<double> all;
    for (const auto& one : at->second) all.push_back(one.first.log_weight);
    return log_sum(all);
  }

  // Families by their single weight, at most so many; those of time alone not before the others.
  std::vector<std::size_t> strongest_families(std::size_t own, std::size_t most) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t f = 0; f < problem_.effects; ++f) {
      const double weight = weight_of({own, {f}});
      if (weight > kNone) order.emplace_back(weight, f);
    }
    std::sort(order.rbegin(), order.rend());
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < std::min(most, order.size()); ++k) result.push_back(order[k].second);
    return result;
  }

  std::vector<std::size_t> shapes_thinned(std::size_t family, std::size_t most) const {
    const Family& one = problem_.library.families[family];
    const std::size_t stride = 1 + (one.count - 1) / most;
    std::vector<std::size_t> result;
    for (std::size_t i = one.first + (stride - 1) / 2; i < one.first + one.count; i += stride) result.push_back(i);
    result.insert(result.end(), one.more.begin(), one.more.end());
    return result;
  }

  // Every pair of the chosen signatures of two families at one point, into `found`.
  void pairs_among(std::size_t g, std::size_t v, const std::vector<std::size_t>& chosen,
                   const std::vector<std::pair<std::size_t, std::size_t>>* only, std::map<Key, Found>& found) const {
    const Point& point = result_.points[g];
    const Variant& variant = result_.variants[v];
    const RowMajorMatrix columns = columns_of(chosen);
    const Seen seen = seen_at(point, variant, columns, chosen, true);
    std::map<std::size_t, std::vector<std::size_t>> of_family;  // places
    for (std::size_t k = 0; k < chosen.size(); ++k) of_family[family_of(chosen[k])].push_back(k);
    std::vector<double> shapes;
    for (auto a = of_family.begin(); a != of_family.end(); ++a) {
      for (auto b = std::next(a); b != of_family.end(); ++b) {
        if (only != nullptr && std::find(only->begin(), only->end(), std::pair{a->first, b->first}) == only->end())
          continue;
        const Key key{variant.own, {a->first, b->first}};
        const double prior = log_prior(key) + point.covariance.log_prior - chosen_prior(chosen, a->second) -
                             chosen_prior(chosen, b->second);
        Found one;
        shapes.clear();
        for (const std::size_t i : a->second) {
          if (!survives(seen, seen.first[i])) continue;
          for (const std::size_t j : b->second) {
            if (!survives(seen, seen.first[j])) continue;
            const double value = pair_evidence(seen, chosen, i, j);
            if (value == kNone) continue;
            shapes.push_back(value + prior + problem_.log_prior_of_shape[chosen[i]] +
                             problem_.log_prior_of_shape[chosen[j]]);
            if (shapes.back() > one.most) {
              one.most = shapes.back();
              one.signatures = {chosen[i], chosen[j]};
            }
          }
        }
        if (shapes.empty()) continue;
        one.log_weight = log_sum(shapes);
        Found& there = found[key];
        if (one.log_weight > there.log_weight) there = std::move(one);
      }
    }
  }

  // ln of the prior of a family's shapes that are chosen, together.
  double chosen_prior(const std::vector<std::size_t>& chosen, const std::vector<std::size_t>& places) const {
    std::vector<double> priors;
    priors.reserve(places.size());
    for (const std::size_t k : places) priors.push_back(problem_.log_prior_of_shape[chosen[k]]);
    return log_sum(priors);
  }

  double pair_evidence(const Seen& seen, const std::vector<std::size_t>& chosen, std::size_t i, std::size_t j) const {
    const Signature &a = problem_.library.signatures[chosen[i]], &b = problem_.library.signatures[chosen[j]];
    const Eigen::Index fa = seen.first[i], fb = seen.first[j];
    if (a.width == 1 && b.width == 1) {
      return log_evidence_of_two(seen.base, seen.left(fa, fa), seen.left(fb, fb), seen.left(fa, fb),
                                 seen.base.along[fa], seen.base.along[fb]);
    }
    std::vector<Eigen::Index> places;
    for (Eigen::Index k = 0; k < a.width; ++k) places.push_back(fa + k);
    for (Eigen::Index k = 0; k < b.width; ++k) places.push_back(fb + k);
    return log_evidence(seen.base, seen.left(places, places), seen.base.along(places));
  }

  // Pairs on a thin grid, then the best of them on all their shapes and at their own likely points; triples from those.
  void pairs(std::size_t v) {
    if (largest_ < 2 || problem_.library.families.size() < 2) return;
    const std::size_t own = result_.variants[v].own;
    const std::vector<std::size_t> families = strongest_families(own, kFamiliesInPairs);
    const std::size_t shapes_each =
        std::clamp<std::size_t>(kShapesInPairs / std::max<std::size_t>(1, families.size()), 3, 14);
    std::vector<std::size_t> chosen;
    for (const std::size_t family : families) {
      for (const std::size_t i : shapes_thinned(family, shapes_each)) chosen.push_back(i);
    }
    std::sort(chosen.begin(), chosen.end());
    const std::vector<std::size_t> at = best_points(own, kPairPoints);
    std::vector<std::map<Key, Found>> found(at.size());
    in_parallel(at.size(), [&](std::size_t k) { pairs_among(at[k], v, chosen, nullptr, found[k]); });
    std::map<Key, double> weight;
    for (const auto& one : found) {
      for (const auto& [key, pair] : one) {
        double& now = weight.try_emplace(key, kNone).first->second;
        now = std::max(now, pair.log_weight);
      }
    }
    std::vector<std::pair<double, Key>> order;
    for (const auto& [key, value] : weight) order.emplace_back(value, key);
    std::sort(order.rbegin(), order.rend());
    for (std::size_t k = 0; k < at.size(); ++k) {
      for (auto& [key, pair] : found[k]) table_.add(key, at[k], v, std::move(pair));
    }
    if (order.empty()) return;
    refine_pairs(v, order);
  }

  void refine_pairs(std::size_t v, const std::vector<std::pair<double, Key>>& order) {
    std::vector<std::pair<std::size_t, std::size_t>> only;
    std::vector<std::size_t> families;
    for (std::size_t k = 0; k < std::min(order.size(), kPairsRefined); ++k) {
      if (order[k].first < order[0].first - kFarFromBest) break;
      const std::vector<std::size_t>& pair = order[k].second.families;
      only.emplace_back(pair[0], pair[1]);
      for (const std::size_t family : pair) {
        if (std::find(families.begin(), families.end(), family) == families.end()) families.push_back(family);
      }
    }
    const std::size_t shapes_each = std::clamp(kColumnsRefined / families.size(), kThinShapes, kShapesRefined);
    std::vector<std::size_t> chosen;
    for (const std::size_t family : families) {
      for (const std::size_t i : shapes_thinned(family, shapes_each)) chosen.push_back(i);
    }
    std::sort(chosen.begin(), chosen.end());
    // Where the best pair is likely: its two columns at every point.
    const std::size_t own = result_.variants[v].own;
    std::vector<double> at_point(result_.points.size(), kNone);
    std::vector<std::size_t> best;
    double most = kNone;
    for (const auto& one : table_.sets[order[0].second]) {
      if (one.first.most > most) {
        most = one.first.most;
        best = one.first.signatures;
      }
    }
    in_parallel(result_.points.size(), [&](std::size_t g) {
      std::map<Key, Found> found;
      pairs_among(g, v, best, nullptr, found);
      if (!found.empty()) at_point[g] = found.begin()->second.log_weight;
    });
    std::vector<std::size_t> points(result_.points.size());
    std::iota(points.begin(), points.end(), std::size_t{0});
    std::sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) { return at_point[a] > at_point[b]; });
    points.resize(std::min(points.size(), kPairPoints));
    std::vector<std::map<Key, Found>> found(points.size());
    in_parallel(points.size(), [&](std::size_t k) { pairs_among(points[k], v, chosen, &only, found[k]); });
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (auto& [key, pair] : found[k]) table_.add(key, points[k], v, std::move(pair));
    }
    if (largest_ >= 3) triples(v, own, points);
  }

  // One more effect beside the best pairs.
  void triples(std::size_t v, std::size_t own, const std::vector<std::size_t>& points) {
    std::vector<std::pair<double, Key>> order;
    for (const auto& [key, at] : table_.sets) {
      if (key.own == own && key.families.size() == 2) order.emplace_back(weight_of(key), key);
    }
    std::sort(order.rbegin(), order.rend());
    if (order.size() > kPairsExtended) order.resize(kPairsExtended);
    const std::vector<std::size_t> families = strongest_families(own, kFamiliesInPairs);
    std::vector<std::map<Key, Found>> found(points.size());
    in_parallel(points.size(), [&](std::size_t k) {
      const Point& point = result_.points[points[k]];
      for (const auto& [value, key] : order) {
        const auto& at = table_.sets.at(key);
        const std::vector<std::size_t>* best = nullptr;
        double most = kNone;
        for (const auto& one : at) {
          if (one.first.most > most) {
            most = one.first.most;
            best = &one.first.signatures;
          }
        }
        if (best == nullptr || best->size() != 2) continue;
        std::vector<std::size_t> chosen = *best;
        for (const std::size_t family : families) {
          if (family == key.families[0] || family == key.families[1]) continue;
          for (const std::size_t i : shapes_thinned(family, kThinShapes)) chosen.push_back(i);
        }
        const RowMajorMatrix columns = columns_of(chosen);
        const Seen seen = seen_at(point, result_.variants[v], columns, chosen, true);
        std::map<std::size_t, std::pair<std::vector<double>, Found>> third;
        for (std::size_t i = 2; i < chosen.size(); ++i) {
          if (!survives(seen, seen.first[i])) continue;
          std::vector<Eigen::Index> places;
          for (const std::size_t one : {std::size_t{0}, std::size_t{1}, i}) {
            for (Eigen::Index w = 0; w < problem_.library.signatures[chosen[one]].width; ++w)
              places.push_back(seen.first[one] + w);
          }
          const double evidence = log_evidence(seen.base, seen.left(places, places), seen.base.along(places));
          auto& [values, one] = third[family_of(chosen[i])];
          values.push_back(evidence);
          if (evidence > one.most) {
            one.most = evidence;
            one.signatures = {chosen[0], chosen[1], chosen[i]};
          }
        }
        for (auto& [family, both] : third) {
          auto& [values, one] = both;
          Key triple{own, {key.families[0], key.families[1], family}};
          std::sort(triple.families.begin(), triple.families.end());
          // The shapes of the first two are at their best alone: what they are worth as a share of their grid.
          double pair_shapes = 0.0;
          for (const auto& there : at) {
            if (there.first.most == most) pair_shapes = there.first.log_weight - there.first.most;
          }
          const double prior = log_prior(triple) + point.covariance.log_prior -
                               std::log(static_cast<double>(problem_.library.families[key.families[0]].count)) -
                               std::log(static_cast<double>(problem_.library.families[key.families[1]].count));
          one.log_weight = log_sum(values) - std::log(static_cast<double>(values.size())) + prior + pair_shapes;
          one.most += prior;
          Found& there = found[k][triple];
          if (one.log_weight > there.log_weight) there = std::move(one);
        }
      }
    });
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (auto& [key, triple] : found[k]) table_.add(key, points[k], v, std::move(triple));
    }
  }

  // Each held parameter free, where that is nearly as likely as the best so far, or raises the likelihood.
  void add_own() {
    for (std::size_t k = 0; k < problem_.own.size(); ++k) {
      const std::size_t g = best_points(0, 1).front();
      const CovarianceFilter& filter = result_.points[g].filter;
      const OwnParameter& own = problem_.own[k];
      const Parameter& parameter = problem_.base_model->parameter(own.parameter);
      std::vector<double> values{own.held};
      for (const double value : parameter.grid) {
        if (parameter.unit != "s" && std::abs(value - own.held) > 1e-9) values.push_back(value);
      }
      if (parameter.unit == "s" && own.held > 0.0) {
        for (const double factor : {0.3, 3.0}) values.push_back(own.held * factor);
      }
      Refined best;
      best.log_evidence = kNone;
      for (const double value : values) {
        if (value < parameter.lower || value > parameter.upper) continue;
        std::vector<double> start = result_.variants[0].parameters;
        start[own.parameter] = value;
        Refined now =
            refined(*problem_.base_model, start, {own.parameter}, result_.variants[0].times, filter, problem_.known, 6);
        if (now.log_evidence > best.log_evidence) best = std::move(now);
      }
      if (best.log_evidence == kNone) continue;
      result_.variants.push_back(variant_at(k + 1, best.parameters, nullptr));
      singles(result_.variants.size() - 1);
    }
  }

  // About where the best sets have the parameters of the model. False: it is there already.
  bool relinearise() {
    std::vector<std::pair<double, Key>> order;
    for (const auto& [key, at] : table_.sets) {
      if (key.families.empty() || key.families.back() < problem_.effects) order.emplace_back(weight_of(key), key);
    }
    std::sort(order.rbegin(), order.rend());
    bool moved = false;
    std::size_t tried = 0;
    if (!wanted_.families.empty()) {
      const auto at = std::find_if(order.begin(), order.end(), [&](const auto& one) { return one.second == wanted_; });
      if (at != order.end()) std::rotate(order.begin() + (at == order.begin() ? 0 : 1), at, at + 1);
    }
    for (const auto& [weight, key] : order) {
      const bool is_wanted = !wanted_.families.empty() && key == wanted_;
      if (!is_wanted && (tried == kSetsRelinearised || weight < order.front().first - kFarFromBest)) break;
      if ((key.families.size() > 2 && !is_wanted) ||
          std::count(relinearised_.begin(), relinearised_.end(), key) == kRelinearised)
        continue;
      ++tried;
      moved = relinearise_at(key, tried == 1) || moved;
      // What is held to be another value is held against the model as it is on equal terms.
      if (key.own != 0) moved = relinearise_at({0, key.families}, false) || moved;
    }
    return moved;
  }

  // all: whatever else is likely with the model there, too.
  bool relinearise_at(const Key& key, bool all) {
    relinearised_.push_back(key);
    const auto there = table_.sets.find(key);
    if (there == table_.sets.end()) return false;
    const auto& at = there->second;
    std::size_t g = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (at[k].first.most > at[g].first.most) g = k;
    }
    if (at.empty() || at[g].first.most == kNone) return false;
    const std::size_t v = at[g].second;
    std::vector<std::size_t> signatures = at[g].first.signatures;
    Beside beside = parameters_beside(result_.variants[v], signatures, g);
    bool has_new = false;
    if (!signatures.empty() && at[g].first.most - likeliest_without() > kStrong) {
      has_new = sharpen(result_.variants[v], g, beside, signatures);
    }
    if (!has_new && !is_elsewhere(result_.variants[v], beside.parameters) && (!all || signatures.empty())) return false;
    const Eigen::MatrixXd times = all ? times_with(beside, signatures) : result_.variants[v].times;
    result_.variants.push_back(variant_at(key.own, beside.parameters, &times));
    const std::size_t next = result_.variants.size() - 1;
    if (all) {
      singles(next);
      if (key.families.size() > 1) pairs(next);
    } else if (key.families.size() == 2) {
      pair_on_all_shapes(next, key);
    } else if (key.families.size() < 2) {
      singles(next, &key.families);
    }
    if (key == wanted_) weigh_wanted(next);
    return true;
  }

  double likeliest_without() const {
    double most = kNone;
    const auto none = table_.sets.find(Key{});
    if (none == table_.sets.end()) return most;
    for (const auto& one : none->second) most = std::max(most, one.first.most);
    return most;
  }

  // What a strong effect leaves where the truth lies between two points of the grid another effect would fill in: the
  // shapes of the set at their likeliest become points. Whether any is new.
  bool sharpen(const Variant& variant, std::size_t g, Beside& beside, std::vector<std::size_t>& signatures) {
    const auto [model, start] = with_effects(beside, signatures);
    const BaseModel with(model, problem_.logged, problem_.y, problem_.base.row);
    const Refined best = refined(with, start, free_of(variant.own), variant.times, result_.points[g].filter,
                                 problem_.known, kStepsBeside);
    const std::size_t own = beside.parameters.size();
    std::copy_n(best.parameters.begin(), own, beside.parameters.begin());
    bool any = false;
    std::size_t place = own;
    for (std::size_t& i : signatures) {
      const Signature old = problem_.library.signatures[i];
      std::vector<double> point = old.point;
      bool moved = false;
      for (std::size_t k = 0; k < point.size(); ++k, ++place) {
        const Parameter& parameter = problem_.library.families[old.family].bound.effect->parameters[k];
        if (parameter.kind == ParameterKind::gain) continue;
        moved = moved || std::abs(best.parameters[place] - point[k]) > kSameShape * std::abs(point[k]);
        point[k] = best.parameters[place];
      }
      if (!moved) continue;
      if (const std::optional<std::size_t> added = add_signature(problem_, old.family, point)) {
        all_.push_back(*added);
        i = *added;
        any = true;
      }
    }
    return any;
  }

  // What is not known of the times of the inputs of the model and of these effects.
  Eigen::MatrixXd times_with(const Beside& beside, const std::vector<std::size_t>& signatures) const {
    const auto [model, parameters] = with_effects(beside, signatures);
    return BaseModel(model, problem_.logged, problem_.y, problem_.base.row).times_at(parameters);
  }

  // The model with these effects as terms, and its parameters.
  std::pair<Model, std::vector<double>> with_effects(const Beside& beside,
                                                     const std::vector<std::size_t>& signatures) const {
    Model model = problem_.model;
    std::vector<double> parameters = beside.parameters;
    Eigen::Index column = 0;
    for (const std::size_t i : signatures) {
      const Signature& one = problem_.library.signatures[i];
      const BoundEffect& bound = problem_.library.families[one.family].bound;
      model.terms.push_back(ballbar::term_of(*bound.effect, bound.columns));
      Eigen::Index gain = 0;
      for (std::size_t k = 0; k < one.point.size(); ++k) {
        Setting& setting = model.terms.back().settings[k];
        if (bound.effect->parameters[k].kind != ParameterKind::gain || gain == one.width) {
          parameters.push_back(std::clamp(one.point[k], setting.lower, setting.upper));
          continue;
        }
        // A new signature of the set has no coefficient yet: any will do, it is linear.
        const bool known = column + gain < beside.coefficients.size();
        parameters.push_back(known ? beside.coefficients[column + gain] / problem_.deviation[one.first + gain] : 0.0);
        ++gain;
      }
      column += one.width;
    }
    return {std::move(model), std::move(parameters)};
  }

  void weigh_wanted(std::size_t v) {
    if (wanted_.families.size() < 2) return;
    if (wanted_.families.size() == 2) {
      pair_on_all_shapes(v, wanted_);
      return;
    }
    // Of many the best shape of one after the other, beside the others as they are.
    std::vector<std::size_t> now;
    for (const std::size_t family : wanted_.families) {
      const auto& single = table_.sets[{0, {family}}];
      const Found* best = nullptr;
      for (const auto& one : single) {
        if (best == nullptr || one.first.most > best->most) best = &one.first;
      }
      if (best == nullptr || best->signatures.empty()) return;
      now.push_back(best->signatures.front());
    }
    const std::vector<std::size_t> points = best_points(0, kPairPoints);
    std::vector<Found> found(points.size());
    in_parallel(points.size(), [&](std::size_t k) {
      const Point& point = result_.points[points[k]];
      std::vector<std::size_t> set = now;
      for (int round = 0; round < 2; ++round) {
        for (std::size_t m = 0; m < set.size(); ++m) {
          std::vector<std::size_t> chosen = set;
          chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(m));
          const std::size_t others = chosen.size();
          for (const std::size_t i : shapes_thinned(wanted_.families[m], kShapesRefined)) chosen.push_back(i);
          const RowMajorMatrix columns = columns_of(chosen);
          const Seen seen = seen_at(point, result_.variants[v], columns, chosen, true);
          std::vector<double> values;
          double best = kNone;
          for (std::size_t i = others; i < chosen.size(); ++i) {
            std::vector<Eigen::Index> places;
            for (std::size_t one = 0; one <= others; ++one) {
              const std::size_t k_of = one == others ? i : one;
              for (Eigen::Index w = 0; w < problem_.library.signatures[chosen[k_of]].width; ++w)
                places.push_back(seen.first[k_of] + w);
            }
            values.push_back(log_evidence(seen.base, seen.left(places, places), seen.base.along(places)));
            if (values.back() > best) {
              best = values.back();
              set[m] = chosen[i];
            }
          }
          found[k].log_weight = log_sum(values) - std::log(static_cast<double>(values.size())) + log_prior(wanted_) +
                                point.covariance.log_prior;
          found[k].most = best + log_prior(wanted_) + point.covariance.log_prior;
          found[k].signatures = set;
        }
      }
    });
    for (std::size_t k = 0; k < points.size(); ++k) table_.add(wanted_, points[k], v, std::move(found[k]));
  }

  void pair_on_all_shapes(std::size_t v, const Key& key) {
    std::vector<std::size_t> chosen;
    for (const std::size_t family : key.families) {
      for (const std::size_t i : shapes_thinned(family, kShapesRefined)) chosen.push_back(i);
    }
    std::sort(chosen.begin(), chosen.end());
    const std::vector<std::size_t> points = best_points(key.own, kPairPoints);
    std::vector<std::map<Key, Found>> found(points.size());
    in_parallel(points.size(), [&](std::size_t k) { pairs_among(points[k], v, chosen, nullptr, found[k]); });
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (auto& [pair, one] : found[k]) table_.add(pair, points[k], v, std::move(one));
    }
  }

  // The model's parameters with these signatures beside it.
  Beside parameters_beside(const Variant& variant, const std::vector<std::size_t>& signatures, std::size_t g) const {
    // Signatures as columns whose gains are free: into what moves with the model.
    Beside beside{variant.parameters, {}};
    std::vector<double>& parameters = beside.parameters;
    for (int round = 0; round < kStepsBeside; ++round) {
      const BaseColumns columns = problem_.base_model->at(parameters, free_of(variant.own));
      const Eigen::Index times = variant.times.cols();
      RowMajorMatrix pool(problem_.y.size(), 1 + columns.values.cols() + times + width_of(signatures));
      pool.leftCols(1 + columns.values.cols() + times) = pool_of(columns, variant.times);
      pool.rightCols(width_of(signatures)) = columns_of(signatures);
      Line line = line_of(columns, times, 0);
      for (Eigen::Index k = 0; k < width_of(signatures); ++k) {
        line.columns.push_back(1 + columns.values.cols() + times + k);
        line.is_free.push_back(1);
      }
      const Gram gram = gram_of(result_.points[g].filter, pool, RowMajorMatrix(pool.rows(), 0));
      const Solved solution = solved(gram, line, problem_.known);
      beside.coefficients = solution.coefficients.tail(width_of(signatures));
      double largest = 0.0;
      for (std::size_t k = 0; k < columns.columns.size(); ++k) {
        const BaseColumn& column = columns.columns[k];
        const double coefficient = solution.coefficients[static_cast<Eigen::Index>(k)];
        double& value = parameters[column.parameter];
        if (column.is_free()) {
          value = coefficient * column.scale;
          continue;
        }
        const double step = std::clamp(coefficient, -0.7, 0.7);
        largest = std::max(largest, std::abs(step));
        const Setting& setting = problem_.base_model->setting(column.parameter);
        const bool is_positive = value > 0.0 && problem_.base_model->parameter(column.parameter).unit != "1";
        value = std::clamp(is_positive ? value * std::exp(step * column.scale / value) : value + step * column.scale,
                           std::min(setting.lower, value), std::max(setting.upper, value));
      }
      if (largest < 0.01) break;
    }
    return beside;
  }

  bool is_elsewhere(const Variant& variant, const std::vector<double>& parameters) const {
    for (std::size_t k = 1; k < parameters.size(); ++k) {
      const Parameter& parameter = problem_.base_model->parameter(k);
      if (parameter.kind == ParameterKind::gain) continue;
      if (std::abs(parameters[k] - variant.parameters[k]) > 0.02 * reach_of(parameter, variant.parameters[k]))
        return true;
    }
    return false;
  }

  // A time that is no longer than what a logger leaves open.
  bool is_within_a_sample(const Effect& effect, const std::vector<double>& point, const std::string& name) const {
    const auto input = std::find_if(problem_.logged.inputs.begin(), problem_.logged.inputs.end(),
                                    [&](const LoggedInput& one) { return one.column == name; });
    if (input == problem_.logged.inputs.end()) return false;
    for (std::size_t k = 0; k < point.size(); ++k) {
      const bool is_time = effect.parameters[k].kind == ParameterKind::shape && effect.parameters[k].unit == "s";
      if (is_time && std::abs(point[k]) <= 2.0 * input->sample_s) return true;
    }
    return false;
  }

  // An effect on a signal of another one, which has that one's gain, with a gain far from it: something else.
  bool is_inconsistent(const EffectSet& set) const {
    Eigen::Index column = 0;
    for (const std::size_t i : set.signatures) {
      const Signature& one = problem_.library.signatures[i];
      const BoundEffect& bound = problem_.library.families[one.family].bound;
      const auto of_another = std::find_if(bound.effect->inputs.begin(), bound.effect->inputs.end(),
                                           [](const Input& input) { return input.of_another_effect; });
      if (of_another != bound.effect->inputs.end()) {
        const std::string& name = bound.columns[static_cast<std::size_t>(of_another - bound.effect->inputs.begin())];
        const Beside beside = parameters_beside(result_.variants[set.variant], set.signatures, set.point);
        const double gain = beside.coefficients[column] / problem_.deviation[one.first];
        bool agrees = false;
        std::size_t first = 1;
        for (const Term& term : problem_.model.terms) {
          const bool reads = std::find(term.columns.begin(), term.columns.end(), name) != term.columns.end();
          for (std::size_t k = 0; k < term.settings.size() && reads; ++k) {
            if (term.effect->parameters[k].kind != ParameterKind::gain) continue;
            const double ratio = gain / beside.parameters[first + k];
            agrees = agrees || (ratio > 0.5 && ratio < 2.0);
          }
          first += term.settings.size();
        }
        if (!agrees || is_within_a_sample(*bound.effect, one.point, name)) return true;
      }
      column += one.width;
    }
    return false;
  }

  void sum_up() {
    std::vector<double> all;
    for (const auto& [key, at] : table_.sets) {
      EffectSet set;
      set.families = key.families;
      set.own = key.own;
      std::vector<double> any, slow;
      set.most = kNone;
      for (std::size_t g = 0; g < at.size(); ++g) {
        const auto& [found, variant] = at[g];
        if (found.log_weight == kNone) continue;
        any.push_back(found.log_weight);
        if (result_.points[g].covariance.slow > 0.0) slow.push_back(found.log_weight);
        if (found.most > set.most) {
          set.most = found.most;
          set.signatures = found.signatures;
          set.point = g;
          set.variant = variant;
        }
      }
      if (any.empty() || is_inconsistent(set)) continue;
      set.log_weight = log_sum(any);
      set.log_weight_slow = log_sum(slow);
      if (!set.families.empty() && set.families.back() >= problem_.effects) {
        result_.any_form.push_back(std::move(set));
        continue;
      }
      all.push_back(set.log_weight);
      result_.sets.push_back(std::move(set));
    }
    std::stable_sort(result_.sets.begin(), result_.sets.end(),
                     [](const EffectSet& a, const EffectSet& b) { return a.log_weight > b.log_weight; });
    result_.log_total = log_sum(all);
  }

  Problem& problem_;
  std::size_t largest_;
  std::vector<std::size_t> thin_, all_;
  Posterior result_;
  Table table_;
  Key wanted_;
  std::vector<Key> relinearised_;
};

}  // namespace

double log_prior_of_set(const Problem& problem, const std::vector<std::size_t>& families, std::size_t own) {
  double sum = prior_of_size(families.size());
  for (const std::size_t family : families) sum += problem.log_prior[family];
  for (std::size_t k = 2; k <= families.size(); ++k) sum += std::log(static_cast<double>(k));
  if (problem.own.empty()) return sum;
  return sum +
         (own == 0 ? std::log(1.0 - kPriorOfOwn) : std::log(kPriorOfOwn / static_cast<double>(problem.own.size())));
}

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior posterior_of(Problem& problem, std::size_t largest_set, std::vector<std::size_t> wanted) {
  return Search(problem, largest_set, std::move(wanted)).run();
}

}  // namespace ballbar
