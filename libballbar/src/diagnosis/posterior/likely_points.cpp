#include "diagnosis/posterior/likely_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/posterior/seen.hpp"
#include "diagnosis/posterior/set_prior.hpp"

namespace ballbar {
namespace {

constexpr double kLeastOfRichest = -30.0;  // ln of the prior that the richest model leaves a covariance
constexpr double kPriceOfGain = 3.0;       // ln, about that of d

std::vector<Point> points_of_grid(const Problem& problem) {
  std::vector<Point> points;
  points.reserve(problem.covariances.size());
  for (const Covariance& one : problem.covariances)
    points.push_back({one, CovarianceFilter(one, problem.time_s, problem.relative_variance)});
  return points;
}

// Of each covariance the first with the same noise, whatever is slow.
std::vector<std::size_t> first_of_same_noise(const std::vector<Point>& points) {
  std::vector<std::size_t> first(points.size());
  for (std::size_t g = 0; g < first.size(); ++g) {
    const Covariance& one = points[g].covariance;
    const auto same = std::find_if(
        points.begin(), points.begin() + static_cast<std::ptrdiff_t>(g),
        [&](const Point& k) { return k.covariance.white == one.white && k.covariance.time_s == one.time_s; });
    first[g] = static_cast<std::size_t>(same - points.begin());
  }
  return first;
}

// ln of the evidence of every input in any form, all together, by the noise of each covariance.
std::vector<double> log_evidence_of_richest(const Problem& problem, const Variant& variant,
                                            const std::vector<Point>& points, const std::vector<std::size_t>& forms) {
  const Chosen chosen = chosen_of(problem, forms);
  const double share = 1.0 / static_cast<double>(chosen.columns.cols());
  const std::vector<std::size_t> first = first_of_same_noise(points);
  std::vector<double> evidence(points.size());
  in_parallel(points.size(), [&](std::size_t g) {
    if (first[g] != g) return;
    Covariance noise = points[g].covariance;
    noise.slow = 0.0;
    const Point point{noise, points[g].covariance.slow > 0.0
                                 ? CovarianceFilter(noise, problem.time_s, problem.relative_variance)
                                 : points[g].filter};
    const Seen seen = seen_with_products(problem, point, variant, chosen.columns);
    evidence[g] = log_evidence(seen.base, seen.left, seen.base.along, share);
  });
  for (std::size_t g = 0; g < evidence.size(); ++g) evidence[g] = evidence[first[g]];
  return evidence;
}

// A poor model's noise holds what it lacks.
std::vector<Point> judged_by_richest(const Problem& problem, const Variant& variant, std::vector<Point> points) {
  std::vector<std::size_t> forms;
  for (std::size_t f = problem.effects; f < problem.library.families.size(); ++f)
    forms.push_back(problem.library.families[f].first);
  if (forms.empty() || points.size() < 2) return points;
  const std::vector<double> evidence = log_evidence_of_richest(problem, variant, points, forms);
  for (const bool slow : {false, true}) {
    std::vector<double> of_these;
    for (std::size_t g = 0; g < points.size(); ++g) {
      if ((points[g].covariance.slow > 0.0) == slow) of_these.push_back(kRichestNoise * evidence[g]);
    }
    if (of_these.empty()) continue;
    const double all = log_sum(of_these) - std::log(static_cast<double>(of_these.size()));
    for (std::size_t g = 0; g < points.size(); ++g) {
      if ((points[g].covariance.slow > 0.0) != slow) continue;
      double& prior = points[g].covariance.log_prior;
      prior = std::max(prior + kRichestNoise * evidence[g] - all, prior + kLeastOfRichest);
    }
  }
  return points;
}

std::vector<std::size_t> thin_signatures(const Problem& problem) {
  std::vector<std::size_t> thin;
  for (std::size_t f = 0; f < problem.effects; ++f) {
    const Family& family = problem.library.families[f];
    const std::size_t most = std::clamp<std::size_t>(kThinColumns / problem.effects, 1, kThinShapes);
    const std::size_t stride = 1 + (family.count - 1) / most;
    for (std::size_t i = family.first + stride / 2; i < family.first + family.count; i += stride) thin.push_back(i);
    thin.insert(thin.end(), family.more.begin(), family.more.end());
  }
  return thin;
}

// ln of the evidence at one point.
struct Alone {
  double none = kLogZero;
  std::vector<double> each;  // of the thin signatures
};

std::vector<Alone> log_evidence_alone(const Problem& problem, const Variant& variant, const std::vector<Point>& points,
                                      const Chosen& thin) {
  std::vector<Alone> alone(points.size());
  in_parallel(points.size(), [&](std::size_t g) {
    const Seen seen = seen_at(problem, points[g], variant, thin.columns);
    alone[g].none = log_evidence(seen.base);
    alone[g].each.reserve(thin.signatures.size());
    for (std::size_t k = 0; k < thin.signatures.size(); ++k) {
      alone[g].each.push_back(
          log_evidence_of_seen(problem, points[g], seen, thin.columns, thin.first[k], thin.signatures[k]));
    }
  });
  return alone;
}

// The few of different families that make the readings likeliest alone.
std::vector<std::size_t> strongest_of(const Problem& problem, const std::vector<Point>& points,
                                      const std::vector<std::size_t>& thin, const std::vector<Alone>& alone) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(thin.size());
  for (std::size_t k = 0; k < thin.size(); ++k) {
    double most = kLogZero;
    for (std::size_t g = 0; g < points.size(); ++g)
      most = std::max(most, alone[g].each[k] + points[g].covariance.log_prior);
    order.emplace_back(most, thin[k]);
  }
  std::sort(order.rbegin(), order.rend());
  std::vector<std::size_t> strongest;
  for (const auto& [value, signature] : order) {
    const auto is_of_family = [&, family = problem.library.signatures[signature].family](std::size_t taken) {
      return problem.library.signatures[taken].family == family;
    };
    if (std::any_of(strongest.begin(), strongest.end(), is_of_family)) continue;
    strongest.push_back(signature);
    if (strongest.size() == kStrongest) break;
  }
  return strongest;
}

// ln of prior times evidence of this signature with the likeliest of the few others, or none, at a point.
double log_weight_beside(const Problem& problem, const Point& point, const Variant& with, std::size_t strong,
                         const Chosen& few) {
  const std::vector<Signature>& signatures = problem.library.signatures;
  const std::size_t family = signatures[strong].family;
  const Seen seen = seen_at(problem, point, with, few.columns);
  // Flat to N(0, d^2 s^2): about ln |column| - ln d.
  const double price = 0.5 * std::log(std::max(1e-300, seen.base.variance));
  double best = log_evidence(seen.base);
  for (std::size_t k = 0; k < few.signatures.size(); ++k) {
    const std::size_t other = signatures[few.signatures[k]].family;
    const Eigen::Index column = few.first[k];
    if (other == family || few.width[k] > 1 || !seen.survives(column)) continue;
    best = std::max(
        best, log_evidence(seen.base, seen.base.left[column], seen.base.along[column]) + problem.log_prior[other]);
  }
  return best - price - kPriceOfGain + problem.log_prior[family] + log_prior_of_size(2) + point.covariance.log_prior;
}

// Of the likeliest set at each point. Where two are missing the noise of one alone is too slow: so the strongest few
// together with every other one, too.
std::vector<double> log_weight_of_likeliest(const Problem& problem, const Variant& variant,
                                            const std::vector<Point>& points, bool in_pairs) {
  const Chosen thin = chosen_of(problem, thin_signatures(problem));
  const std::vector<Alone> alone = log_evidence_alone(problem, variant, points, thin);
  std::vector<double> most(points.size());
  for (std::size_t g = 0; g < points.size(); ++g) {
    double best = log_prior_of_size(0) + alone[g].none;
    for (std::size_t k = 0; k < thin.signatures.size(); ++k) {
      const std::size_t family = problem.library.signatures[thin.signatures[k]].family;
      best = std::max(best, alone[g].each[k] + problem.log_prior[family] + log_prior_of_size(1));
    }
    most[g] = best + points[g].covariance.log_prior;
  }
  if (!in_pairs || thin.signatures.empty()) return most;
  std::vector<std::size_t> thinner;
  for (std::size_t k = 0; k < thin.signatures.size(); k += kThinnedFurther) thinner.push_back(thin.signatures[k]);
  const Chosen few = chosen_of(problem, std::move(thinner));
  for (const std::size_t strong : strongest_of(problem, points, thin.signatures, alone)) {
    // In the model's place: a flat gain, its prior by hand.
    const Variant with = with_signatures(problem, variant, {strong});
    in_parallel(points.size(), [&](std::size_t g) {
      most[g] = std::max(most[g], log_weight_beside(problem, points[g], with, strong, few));
    });
  }
  return most;
}

}  // namespace

std::vector<Point> likely_points(const Problem& problem, const Variant& variant, std::size_t largest_set) {
  std::vector<Point> points = judged_by_richest(problem, variant, points_of_grid(problem));
  const std::vector<double> most = log_weight_of_likeliest(problem, variant, points, largest_set > 1);
  const double top = *std::max_element(most.begin(), most.end());
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t g = 0; g < most.size(); ++g) {
    if (most[g] > top - kLikelyPoints) order.emplace_back(most[g], g);
  }
  std::sort(order.rbegin(), order.rend());
  if (order.size() > kMostPoints) order.resize(kMostPoints);
  std::vector<Point> kept;
  kept.reserve(order.size());
  for (const auto& [value, g] : order) kept.push_back(std::move(points[g]));
  return kept;
}

}  // namespace ballbar
