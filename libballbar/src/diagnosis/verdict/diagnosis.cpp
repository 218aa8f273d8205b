#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/internal/series/far_readings.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/posterior/set_regression.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "diagnosis/verdict/coarse_columns.hpp"
#include "diagnosis/verdict/credible_set.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "diagnosis/verdict/discrepancy.hpp"
#include "diagnosis/verdict/fitted_set.hpp"
#include "diagnosis/verdict/gains_by_run.hpp"
#include "diagnosis/verdict/member_tests.hpp"
#include "diagnosis/verdict/not_used.hpp"
#include "diagnosis/verdict/start_values.hpp"
#include "diagnosis/verdict/verdict.hpp"
#include "fit/model_columns.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/standard_deviation.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostShown = 12;    // candidates
constexpr double kLeastShown = 0.01;      // P of an effect
constexpr double kLeastHeldShown = 0.05;  // P of a wrong held value

// No statement about effects that are not searched: those left out, and those that describe a slow drift.
std::vector<Detectability> detectability_but(const SearchOptions& options, std::vector<Detectability> detectability) {
  const auto left_out = [&](const std::string& name) {
    return std::find(options.without.begin(), options.without.end(), name) != options.without.end();
  };
  std::erase_if(detectability,
                [&](const Detectability& one) { return left_out(one.effect->name) || describes_drift(*one.effect); });
  for (Detectability& detectable : detectability) {
    std::erase_if(detectable.imitated_by, [&](const Likeness& likeness) { return left_out(likeness.with); });
  }
  return detectability;
}

// As that of a fit: what is stated of the readings is beside it, here the mean of its variance.
Noise noise_of(const Covariance& covariance, double variance, double stated_variance) {
  Noise noise;
  noise.white_um = std::sqrt(std::max(0.0, variance * covariance.white - stated_variance));
  noise.correlated_um = std::sqrt(variance * covariance.correlated);
  noise.correlation_time_s = covariance.time_s;
  return noise;
}

// The least detectable effect among those that are common, each at its middle shape.
struct Hidden {
  BoundEffect effect;
  double amplitude_um = 0.0;
};
Hidden hidden_of(const Problem& problem, const SignatureProjection& projection) {
  Hidden hidden;
  const SignatureLibrary& library = problem.library;
  for (std::size_t f = 0; f < problem.effects; ++f) {
    const Family& family = library.families[f];
    const Effect& effect = *family.bound.effect;
    if (effect.time_only || (effect.level == Level::series && !effect.rules.is_common)) continue;
    std::vector<double> all_um;
    for (std::size_t i = family.first; i < family.first + family.count; ++i) {
      const double um = detectable_um(library, projection, i, kFound);
      if (projection.share[i] >= kAbsorbed && std::isfinite(um)) all_um.push_back(um);
    }
    if (all_um.empty()) continue;
    const double usual_um = median(std::move(all_um));
    if (usual_um > hidden.amplitude_um) hidden = {family.bound, usual_um};
  }
  return hidden;
}

// Fills what could be detected beside this noise.
void tell_detectability(const Problem& problem, const Model& model, const DiagnosisOptions& options, const Noise& noise,
                        Diagnosis& result) {
  const Fit& base = problem.base;
  const SignatureProjection projection =
      signature_projection(problem.library, model_columns(base), Whitening(noise, base.time_s, base.sigma_um));
  const Hidden hidden = hidden_of(problem, projection);
  result.hidden = hidden.effect;
  result.hidden_um = std::min(hidden.amplitude_um, range_of(base.measured_um));
  result.detectability =
      detectability_but(options.search, detectability_of(options.search.catalogue, problem.library, projection, model,
                                                         problem.logged.series, options.search.motion, problem.time_s));
}

std::vector<EffectProbability> probabilities_of(const Problem& problem, const Posterior& posterior) {
  std::vector<EffectProbability> effects;
  for (std::size_t f = 0; f < problem.effects; ++f) {
    if (posterior.family[f] >= kLeastShown) effects.push_back({problem.library.families[f].bound, posterior.family[f]});
  }
  std::stable_sort(effects.begin(), effects.end(),
                   [](const EffectProbability& a, const EffectProbability& b) { return a.p > b.p; });
  return effects;
}

// Values held in the model that may be wrong.
std::vector<OwnValue> held_values_of(const Problem& problem, const Posterior& posterior) {
  std::vector<OwnValue> values;
  for (std::size_t k = 0; k < problem.held.size(); ++k) {
    if (posterior.held[k] < kLeastHeldShown) continue;
    const auto set = std::find_if(posterior.sets.begin(), posterior.sets.end(),
                                  [&](const EffectSet& one) { return one.freed == k; });
    if (set == posterior.sets.end()) continue;
    const FittedSet fitted = fitted_set(problem, posterior, *set, false);
    const std::size_t place = problem.held[k].parameter;
    const FittedParameter& parameter = fitted.parameters[place];
    values.push_back({parameter.effect, parameter.name, parameter.unit, problem.held[k].value, parameter.value,
                      fitted.intervals[place], posterior.held[k]});
  }
  return values;
}

// Standard deviation of what the model cannot imitate of each member of the set.
std::vector<double> unimitated_um(const SetRegression& at) {
  const RowMajorMatrix& columns = at.model.columns;
  std::vector<Eigen::Index> flat;  // of the model alone
  for (Eigen::Index k = 0; k < (at.first.empty() ? at.size() : at.first.front()); ++k) {
    if (at.model.is_flat[static_cast<std::size_t>(k)] != 0) flat.push_back(1 + k);
  }
  const Eigen::MatrixXd basis = orthonormal(Eigen::MatrixXd(columns(Eigen::all, flat)));
  std::vector<double> sizes_um;
  for (std::size_t m = 0; m < at.first.size(); ++m) {
    const Eigen::VectorXd curve =
        columns.middleCols(1 + at.first[m], at.width[m]) * at.solution.coefficients.segment(at.first[m], at.width[m]);
    const Eigen::VectorXd left = orthogonal_part(curve, basis);
    sizes_um.push_back(std::sqrt(left.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, left.size()))));
  }
  return sizes_um;
}

// Beside a discrepancy the form of an effect cannot be told, and beside a larger one no cause (Brynjarsdottir and
// O'Hagan 2014, Inverse Problems 30, 114007).
void doubt_beside(double discrepancy_um, const SetRegression& at, std::vector<Candidate>& members,
                  std::vector<Driver>& drivers) {
  const std::vector<double> seen_um = unimitated_um(at);
  std::set<std::string> clear;
  for (std::size_t m = 0; m < members.size(); ++m) {
    Candidate& one = members[m];
    const bool is_larger = seen_um[m] >= discrepancy_um;
    if (is_larger) clear.insert(one.bound.columns.begin(), one.bound.columns.end());
    if (!is_jump(*one.bound.effect)) one.doubts.push_back(is_larger ? Doubt::drift_beside : Doubt::larger_drift);
  }
  for (Driver& driver : drivers) driver.is_clear = driver.is_clear && clear.contains(driver.column);
}

// The members of the set, tested.
std::vector<Candidate> members_of(const Inference& inference, const EffectSet& set, const FittedSet& fitted,
                                  const SetRegression& at, double tolerance_um) {
  std::vector<Candidate> members;
  for (std::size_t m = 0; m < set.signatures.size(); ++m) {
    Candidate one = tested_member(inference, set, fitted, at, m);
    one.in_best_set = true;
    one.minor = one.amplitude_um < std::max(kMinor * inference.problem->base.rmse_um, tolerance_um);
    // More likely an input in any form than an effect of the catalogue.
    const std::vector<double>& alpha = inference.posterior.modes.front().effects[set.single[m]].alpha;
    const auto first = alpha.begin() + static_cast<std::ptrdiff_t>(inference.problem->effects),
               end = alpha.begin() + static_cast<std::ptrdiff_t>(inference.problem->library.families.size());
    one.other_form_likelier = std::accumulate(first, end, 0.0) > std::accumulate(alpha.begin(), first, 0.0);
    members.push_back(std::move(one));
  }
  return members;
}

// The effects of the credible set of each single effect, the most probable first.
std::vector<std::vector<BoundEffect>> alternatives_of(const Inference& inference, const EffectSet& set) {
  std::vector<std::vector<BoundEffect>> result;
  for (const std::size_t l : set.single) {
    result.emplace_back();
    for (const std::size_t i :
         credible_set(inference.posterior.modes.front().effects[l], inference.problem->tuning.credible)) {
      if (i < inference.problem->effects) result.back().push_back(inference.problem->library.families[i].bound);
    }
  }
  return result;
}

// After the best set the other probable effects, each with the rest of its own best set.
void add_other_candidates(const Inference& inference, Diagnosis& result) {
  const Posterior& posterior = inference.posterior;
  for (const EffectProbability& effect : result.effects) {
    if (result.candidates.size() >= kMostShown) break;
    if (candidate_of(result, effect.bound) != nullptr) continue;
    const std::size_t f = *family_of(*inference.problem, effect.bound);
    const auto set = std::find_if(posterior.sets.begin(), posterior.sets.end(), [&](const EffectSet& one) {
      return std::find(one.families.begin(), one.families.end(), f) != one.families.end();
    });
    if (set == posterior.sets.end()) continue;
    const FittedSet fitted = fitted_set(*inference.problem, posterior, *set, false);
    result.candidates.push_back(described_member(inference, *set, fitted, member_of(inference, *set, effect.bound)));
  }
  for (const std::vector<BoundEffect>& group : result.equivalent) {
    for (Candidate& candidate : result.candidates) {
      if (std::find(group.begin(), group.end(), candidate.bound) == group.end()) continue;
      for (const BoundEffect& other : group) {
        if (!(other == candidate.bound)) candidate.inseparable_from.push_back(label_of(other));
      }
    }
  }
}

void describe_discrepancy(const Inference& inference, const Eigen::VectorXd& mean_um, const Catalogue& catalogue,
                          Diagnosis& result) {
  result.p_discrepancy = inference.posterior.discrepancy;
  result.discrepancy_um = standard_deviation(mean_um);
  if (result.p_discrepancy < kDiscrepancy || !(result.discrepancy_um > 0.0)) return;
  const Description like = description_of(catalogue, *inference.problem, mean_um);
  result.discrepancy_like = like.effect;
  result.discrepancy_parameter = like.parameter;
  result.discrepancy_time_s = like.time_s;
}

void tell_what_was_not_used(const Problem& problem, const Model& model, const Series& data, Diagnosis& result) {
  if (model.level != Level::series) return;
  result.has_clock = data.has_clock;
  result.saturated = saturated_sensors(problem);
  result.sensor_jumps = data.sensor_jumps;
  result.equal_columns = problem.logged.equal;
  result.set_aside = far_readings(find_column(data, result.target)->values).size();
  result.level_jumps = problem.level_jumps.size();
  std::vector<double> sizes_um;
  for (const LevelJump& jump : problem.level_jumps) sizes_um.push_back(jump.size_um);
  if (!sizes_um.empty()) result.level_jump_um = median(std::move(sizes_um));
  result.columns_not_searched = columns_not_searched(problem, model);
}

// No posterior, for this reason.
Diagnosis diagnosis_without(Obstacle obstacle, const Problem& problem, const Model& model,
                            const DiagnosisOptions& options, Diagnosis result) {
  result.obstacle = obstacle;
  tell_detectability(problem, model, options, problem.base.noise, result);
  if (obstacle == Obstacle::still_readings) {
    result.rmse_after_um = problem.base.rmse_um;
  } else {
    result.verdict = Verdict::untestable;
    result.noise = problem.base.noise;
  }
  return result;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  constexpr std::string_view kNames[] = {"named",       "probable",   "driver", "equivalent",
                                         "unexplained", "untestable", "nothing"};
  return kNames[static_cast<std::size_t>(verdict)];
}

const Candidate* candidate_of(const Diagnosis& diagnosis, const BoundEffect& bound) {
  const auto at = std::find_if(diagnosis.candidates.begin(), diagnosis.candidates.end(),
                               [&](const Candidate& one) { return one.bound == bound; });
  return at == diagnosis.candidates.end() ? nullptr : &*at;
}

Inference inference_of(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options,
                       const std::vector<Term>& terms, const std::vector<Covariance>& covariances) {
  return inference(model, data, target, {options.search, terms, options.most_rows, {}, covariances});
}

Diagnosis diagnosis_of(Inference& inference, const Model& model, const Series& data, std::size_t target,
                       const DiagnosisOptions& options) {
  const Problem& problem = *inference.problem;
  const Posterior& posterior = inference.posterior;
  const Tuning& tuning = options.search.tuning;
  const auto tell = [&](std::string_view step) {
    if (options.search.progress) options.search.progress(step);
  };
  Diagnosis result;
  result.base = problem.base;
  result.target = problem.base.target;
  result.where = options.where;
  if (inference.is_still) return diagnosis_without(Obstacle::still_readings, problem, model, options, result);
  if (inference.largest == 0) return diagnosis_without(Obstacle::too_few_values, problem, model, options, result);
  if (problem.effects == 0) return diagnosis_without(Obstacle::no_effect, problem, model, options, result);

  // The posterior.
  const EffectSet& best = posterior.sets[posterior.best];  // until sets are requested
  const SetRegression at = set_regression(problem, posterior, best);
  result.p_nothing = posterior.nothing;
  result.effects = probabilities_of(problem, posterior);
  result.own = held_values_of(problem, posterior);
  result.gains_by_run = gains_by_run(problem, posterior, best);
  result.noise = noise_of(posterior.filters[best.filter].covariance, at.solution.variance, problem.known.variance);
  const Eigen::VectorXd slow_um = discrepancy_mean(problem, posterior, best);
  describe_discrepancy(inference, slow_um, options.search.catalogue, result);
  tell_what_was_not_used(problem, model, data, result);
  if (model.level == Level::series) result.drivers = drivers_of(problem, posterior);
  tell_detectability(problem, model, options, result.noise, result);

  // The tests of the members. RMSE as in a fit of the model with these effects by `add` and `check`.
  const bool is_drift_beside =
      tuning.beside_discrepancy && result.p_discrepancy >= kDiscrepancy && result.discrepancy_um > 0.0;
  if (best.families.empty()) {
    result.rmse_after_um = best.freed ? fit(fitted_set(problem, posterior, best, false).model, data, target).rmse_um
                                      : problem.base.rmse_um;
  } else {
    tell(fmt::format("testing {} effects", best.families.size()));
    const FittedSet fitted = fitted_set(problem, posterior, best, true);
    result.rmse_after_um = fit(fitted.model, data, target).rmse_um;
    result.explained_um = std::min(fitted.together_um, range_of(problem.base.measured_um));
    result.candidates = members_of(inference, best, fitted, at, options.tolerance_um);
    if (options.leave_out && model.level == Level::series) {
      tell("leaving cycles out");
      std::vector<std::size_t> terms(result.candidates.size());
      std::iota(terms.begin(), terms.end(), model.terms.size());
      leave_cycles_out(fitted.model, terms, data, target, result.candidates);
    }
  }
  if (tuning.coarse_columns && !best.families.empty())
    result.coarse_columns = coarse_columns(problem, data, at, slow_um, result.candidates);
  const bool is_all_searched = !tuning.columns_not_searched || (result.columns_not_searched.empty() &&
                                                                result.coarse_columns.empty() && result.has_clock);
  for (Driver& driver : result.drivers) driver.is_clear = is_all_searched;
  if (is_drift_beside) doubt_beside(result.discrepancy_um, at, result.candidates, result.drivers);

  const double stated_um = std::sqrt(problem.known.variance);
  Statement said = statement_of({result.candidates, alternatives_of(inference, best), result.drivers, result.own,
                                 result.p_nothing, is_drift_beside, is_all_searched, result.level_jumps > 0,
                                 stated_um > 0.0 && problem.base.rmse_um > tuning.rest * stated_um});
  result.verdict = said.verdict;
  result.named = std::move(said.named);
  result.probable = std::move(said.probable);
  result.equivalent = std::move(said.equivalent);
  add_other_candidates(inference, result);
  // Each effect by itself, as `add` fits it, so that the reported RMSE is the later one.
  for (std::size_t k = 0; k < result.candidates.size() && options.fit_candidates; ++k) {
    tell(fmt::format("fitting candidate {} of {}", k + 1, result.candidates.size()));
    Candidate& one = result.candidates[k];
    one.rmse_after_um = fit(model_with(inference, model, {term_of(problem, one.bound)}), data, target).rmse_um;
  }
  return result;
}

Diagnosis diagnose(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options) {
  Inference found = inference_of(model, data, target, options);
  return diagnosis_of(found, model, data, target, options);
}

}  // namespace ballbar
