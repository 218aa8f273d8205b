#include "diagnosis/posterior/search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/evidence/shape_fit.hpp"
#include "diagnosis/posterior/conditional_fit.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/robust.hpp"
#include "diagnosis/posterior/sets.hpp"
#include "diagnosis/posterior/weighted_ascent.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kSharpenedRivals = 4;  // rivals of a single effect whose shapes are refined
constexpr double kFarMode = 7.0;             // ln: a sum so much less likely is no rival
constexpr double kFarRival = 7.0;            // ln: a rival so much weaker than the strongest is ignored
constexpr double kOfGrid = 0.1;              // more, of the evidence gained: a coarse grid may cost so much
constexpr int kMostRefined = 3;              // times: the model is linear about where it was last
constexpr double kBetterFit = 1e-3;          // of the square
constexpr double kUsualTime_s = 1500.0;      // of a model whose fit has diverged
constexpr double kSameModel = 0.02;          // of a shape's reach
constexpr double kBetter = 0.05;             // ln: smallest improvement
constexpr Stop kSearched{12, 1e-5};

// The most likely covariance of each kind, or the given ones.
std::vector<Covariance> covariances_beside(const Problem& problem, const Variant& beside) {
  if (!problem.covariances.empty()) return problem.covariances;
  const std::vector<Discrepancy> kinds = discrepancies_of(problem);
  std::vector<Covariance> found(kinds.size());
  in_parallel(kinds.size(), [&](std::size_t k) { found[k] = likeliest_covariance(problem, beside, kinds[k]); });
  return found;
}

// Readings far from the others count less, and three or more jumps of the target are levels of their own. Both beside
// the richest model: a missing effect would make its own readings outliers.
void note_outliers(Problem& problem, const std::vector<double>& fit) {
  if (!problem.covariances.empty() || problem.model.level != Level::series) return;
  Variant rich = beside_any_forms(problem, variant_at(problem, 0, fit));
  Covariance covariance = likeliest_covariance(problem, rich, Discrepancy::none);
  problem.level_jumps = level_jumps(problem, residual_beside(problem, rich, point_at(problem, covariance)));
  if (!problem.level_jumps.empty()) {
    rich = beside_any_forms(problem, variant_at(problem, 0, fit));
    covariance = likeliest_covariance(problem, rich, Discrepancy::none);
  }
  weigh_down_outliers(problem, rich, point_at(problem, covariance));
}

// Other values of held parameters that a fit finds.
void find_other_values(Problem& problem, const std::vector<double>& fit, const Variant& variant,
                       const Covariance& covariance) {
  const Point point = point_at(problem, covariance);
  for (OwnParameter& own : problem.own) {
    own.fitted = {
        shape_fit(*problem.base_model, fit, {own.parameter}, variant.times, point.filter, problem.known, kSearched)
            .parameters[own.parameter]};
  }
}

// Of one single effect the effects, the strongest first. Where an input of any form is stronger the shapes of all are
// too coarse to tell which is near.
std::vector<std::size_t> effects_of(const Problem& problem, const SingleEffect& one) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < problem.effects; ++i) {
    if (one.strength[i] > kLogZero) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return one.strength[a] > one.strength[b]; });
  if (order.empty()) return order;
  const double strongest = one.strength[order.front()];
  const double far = strongest - kFarRival - kOfGrid * std::max(0.0, strongest);
  while (order.size() > 1 && one.strength[order.back()] < far) order.pop_back();
  return order;
}

// The held value that is more likely wrong than right.
std::optional<std::size_t> likeliest_own(const Identities& identities, const Ascent& ascent) {
  for (const std::size_t i : likeliest_set(ascent)) {
    if (identities.is_own(i)) return i - identities.families;
  }
  return std::nullopt;
}

// The parameters with all free times of the model at this one.
std::vector<double> with_times(const Problem& problem, std::vector<double> parameters, double time_s) {
  for (std::size_t k = 1; k < problem.base_model->parameters(); ++k) {
    const Setting& setting = problem.base_model->setting(k);
    const Parameter& parameter = problem.base_model->parameter(k);
    if (parameter.kind == ParameterKind::shape && parameter.unit == "s" && !setting.held)
      parameters[k] = std::clamp(time_s, setting.lower, setting.upper);
  }
  return parameters;
}

// The shapes of the sum's effects, and of the rivals of each, at their most likely become signatures; the parameters of
// the model beside these effects.
std::vector<double> refined(Problem& problem, const SearchResult& found, const Point& point) {
  std::vector<std::size_t> set;
  std::vector<std::vector<std::size_t>> rivals;
  for (const SingleEffect& one : found.ascent.effects) {
    if (one.p_any() < 0.5 || found.identities.is_own(likeliest_identity(one))) continue;
    const std::vector<std::size_t> order = effects_of(problem, one);
    std::vector<std::size_t> shapes;
    for (std::size_t k = 0; k < std::min(order.size(), problem.tuning.finer_rivals ? kSharpenedRivals : 1); ++k) {
      if (const auto shape = signature_of(problem, found.identities, one.likeliest[order[k]])) shapes.push_back(*shape);
    }
    if (shapes.empty()) continue;
    set.push_back(shapes.front());
    rivals.emplace_back(shapes.begin() + 1, shapes.end());
  }
  // Beside a held value that is another one, at that one.
  Variant variant = found.variant;
  const std::optional<std::size_t> own = likeliest_own(found.identities, found.ascent);
  if (own) {
    std::vector<double> parameters = variant.parameters;
    parameters[problem.own[*own].parameter] = problem.own[*own].fitted.back();
    variant = variant_at(problem, *own + 1, std::move(parameters));
  }
  ConditionalFit best = sharpened(problem, variant, {set, variant.parameters, {}}, point);
  // Without the effects the fit may have driven a time constant to its bound, from where no step leads back.
  if (std::vector<double> usual = with_times(problem, variant.parameters, kUsualTime_s); usual != variant.parameters) {
    ConditionalFit from_usual = sharpened(problem, variant, {set, std::move(usual), {}}, point);
    if (from_usual.square < (1.0 - kBetterFit) * best.square) best = std::move(from_usual);
  }
  for (std::size_t m = 0; m < rivals.size(); ++m) {
    for (const std::size_t rival : rivals[m]) {
      ConditionalFit other{best.signatures, best.parameters, {}};
      other.signatures[m] = rival;
      sharpened(problem, variant, std::move(other), point);
    }
  }
  if (!own) return best.parameters;
  // The gains beside the held value: what is open of times is in units of the gains.
  OwnParameter& parameter = problem.own[*own];
  parameter.fitted.push_back(best.parameters[parameter.parameter]);
  best.parameters[parameter.parameter] = parameter.held;
  return shape_fit(*problem.base_model, std::move(best.parameters), {}, found.variant.times, point.filter,
                   problem.known, {0})
      .parameters;
}

// Whether a shape of the model has moved by more than kSameModel of its prior sigma.
bool is_elsewhere(const Problem& problem, const Variant& variant, const std::vector<double>& parameters) {
  for (std::size_t k = 1; k < parameters.size(); ++k) {
    const Parameter& parameter = problem.base_model->parameter(k);
    if (parameter.kind == ParameterKind::gain) continue;
    if (std::abs(parameters[k] - variant.parameters[k]) > kSameModel * reach_of(parameter, variant.parameters[k]))
      return true;
  }
  return false;
}

double log_weight_of(const SearchResult& of) { return of.ascent.bound + of.covariances.front().log_prior; }

}  // namespace

SearchResult search_result(Problem& problem, std::size_t largest) {
  const std::vector<double> fit = fitted_parameters(problem);
  note_outliers(problem, fit);
  SearchResult found;
  found.variant = variant_at(problem, 0, fit);
  found.covariances = covariances_beside(problem, beside_any_forms(problem, found.variant));
  find_other_values(problem, fit, found.variant, found.covariances.front());
  found.identities = identities_of(problem, found.variant);
  // The sum at a covariance, from these identities on, without one of them.
  const auto ascended_in = [&](const SearchResult& of, const Covariance& covariance,
                               const std::vector<std::size_t>& from, std::size_t without = kNoSignature) {
    const Point point = point_at(problem, covariance);
    ColumnsAt at(problem, of.identities, of.variant, point);
    return ascended_from(at, of.identities, ascent_options(problem, of.identities, largest, Forms::no, without), from);
  };
  // Of each kind the covariance beside the sum, and the sum there; the most likely first.
  const auto settle = [&](SearchResult& of) {
    std::vector<Ascent> sums(of.covariances.size(), of.ascent);
    in_parallel(sums.size(), [&](std::size_t k) {
      Covariance& covariance = of.covariances[k];
      if (sums[k].effects.empty()) sums[k] = ascended_in(of, covariance, {});
      if (problem.covariances.empty())
        covariance = likeliest_covariance(problem, beside_mean_of(sums[k], of.identities, of.variant),
                                          discrepancy_of(covariance), &covariance);
      sums[k] = ascended_in(of, covariance, likeliest_set(sums[k]));
    });
    std::size_t best = 0;
    const auto log_weight = [&](std::size_t k) { return sums[k].bound + of.covariances[k].log_prior; };
    for (std::size_t k = 1; k < sums.size(); ++k) best = log_weight(k) > log_weight(best) ? k : best;
    std::swap(of.covariances.front(), of.covariances[best]);
    of.ascent = std::move(sums[best]);
  };
  // The model and the shapes about where the sum has them. False: they are there already.
  const auto refine = [&](SearchResult& of) {
    const std::size_t shapes = problem.library.signatures.size();
    const std::vector<std::size_t> set = likeliest_set(of.ascent);
    Variant next = variant_at(problem, 0, refined(problem, of, point_at(problem, of.covariances.front())));
    const bool is_new =
        problem.library.signatures.size() > shapes || is_elsewhere(problem, of.variant, next.parameters);
    of.variant = std::move(next);
    of.identities = identities_of(problem, of.variant);
    of.ascent = ascended_in(of, of.covariances.front(), set);
    return is_new;
  };
  const auto converge = [&](SearchResult& of) {
    for (int round = 0; round < kMostRefined; ++round) {
      const double before = log_weight_of(of);
      const bool is_new = refine(of);
      settle(of);
      if (!is_new && log_weight_of(of) < before + kBetter) break;
    }
  };
  settle(found);
  converge(found);
  if (!problem.tuning.refine) return found;
  // Coordinate ascent finds one mode: the sums without each of its effects (Zou et al. 2022, `refine`).
  for (const std::size_t without : likeliest_set(found.ascent)) {
    if (found.identities.is_own(without)) continue;
    SearchResult other = found;
    other.ascent = ascended_in(other, other.covariances.front(), {}, without);
    refine(other);
    if (other.ascent.bound < found.ascent.bound - kFarMode) continue;
    converge(other);
    if (log_weight_of(other) > log_weight_of(found) + kBetter) found = std::move(other);
  }
  return found;
}

}  // namespace ballbar
