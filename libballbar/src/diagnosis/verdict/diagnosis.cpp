#include "ballbar/diagnosis/verdict/diagnosis.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "ballbar/numerics/order_statistic.hpp"
#include "ballbar/numerics/range.hpp"
#include "ballbar/series/signal_kind.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/posterior/set_regression.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/thresholds.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "diagnosis/verdict/discrepancy.hpp"
#include "diagnosis/verdict/fitted_set.hpp"
#include "diagnosis/verdict/gains_by_run.hpp"
#include "diagnosis/verdict/member_tests.hpp"
#include "diagnosis/verdict/probabilities.hpp"
#include "diagnosis/verdict/start_values.hpp"
#include "fit/far_readings.hpp"
#include "fit/model_columns.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostShown = 12;  // candidates
constexpr double kRest = 3.0;           // of the stated sigma of the readings: a larger remaining error is unexplained

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

Noise noise_of(const Covariance& covariance, double variance) {
  Noise noise;
  noise.white_um = std::sqrt(variance * covariance.white);
  noise.correlated_um = std::sqrt(variance * covariance.correlated);
  noise.correlation_time_s = covariance.time_s;
  return noise;
}

class Decision {
 public:
  Decision(Inference& inference, const Model& model, const Series& data, std::size_t target,
           const DiagnosisOptions& options)
      : inference_(inference), model_(model), data_(data), target_(target), options_(options) {
    result_.base = problem().base;
    result_.target = problem().base.target;
    result_.where = options.where;
    measured_um_ = range_of(problem().base.measured_um);
  }

  Diagnosis run() {
    if (inference_.is_still) return still();
    if (problem().effects == 0 || inference_.largest == 0) return untestable(inference_.largest == 0);
    read_posterior();
    test_members();
    decide();
    show_candidates();
    if (options_.fit_candidates) fit_candidates();
    return std::move(result_);
  }

 private:
  const Tuning& tuning() const { return options_.search.tuning; }
  const Problem& problem() const { return *inference_.problem; }
  const Posterior& posterior() const { return inference_.posterior; }
  const Family& family(std::size_t f) const { return problem().library.families[f]; }

  void tell(std::string_view step) const {
    if (options_.search.progress) options_.search.progress(step);
  }

  Diagnosis still() {
    result_.detectability = detectability_by(problem().base.noise);
    result_.rmse_after_um = problem().base.rmse_um;
    result_.obstacle = Obstacle::still_readings;
    return std::move(result_);
  }

  Diagnosis untestable(bool too_few) {
    result_.verdict = Verdict::untestable;
    result_.noise = problem().base.noise;
    result_.detectability = detectability_by(problem().base.noise);
    result_.obstacle = too_few ? Obstacle::too_few_values : Obstacle::no_effect;
    return std::move(result_);
  }

  // The least detectable effect among those that are common, each at its middle shape.
  void find_what_could_hide(const SignatureProjection& projection) {
    result_.hidden_um = 0.0;
    for (std::size_t f = 0; f < problem().effects; ++f) {
      const Effect& effect = *family(f).bound.effect;
      if (effect.time_only || (effect.level == Level::series && !effect.rules.is_common)) continue;
      std::vector<double> all_um;
      for (std::size_t i = family(f).first; i < family(f).first + family(f).count; ++i) {
        const double um = detectable_um(problem().library, projection, i, kFound);
        if (projection.share[i] >= kAbsorbed && std::isfinite(um)) all_um.push_back(um);
      }
      if (all_um.empty()) continue;
      const double usual_um = median(std::move(all_um));
      if (usual_um <= result_.hidden_um) continue;
      result_.hidden_um = usual_um;
      result_.hidden = family(f).bound;
    }
    result_.hidden_um = std::min(result_.hidden_um, measured_um_);
  }

  std::vector<Detectability> detectability_by(const Noise& noise) {
    const Fit& base = problem().base;
    const Eigen::VectorXd residual =
        Eigen::VectorXd::Map(base.residual_um.data(), static_cast<Eigen::Index>(base.residual_um.size()));
    const SignatureProjection projection = signature_projection(problem().library, residual, model_columns(base),
                                                                Whitening(noise, base.time_s, base.sigma_um));
    find_what_could_hide(projection);
    return detectability_but(options_.search,
                             detectability_of(options_.search.catalogue, problem().library, projection, model_,
                                              problem().logged.series, options_.search.motion, problem().time_s));
  }

  void read_posterior() {
    result_.p_nothing = posterior().nothing;
    result_.p_discrepancy = posterior().discrepancy;
    if (model_.level == Level::series) result_.drivers = drivers_of(problem(), posterior());
    for (std::size_t f = 0; f < problem().effects; ++f) {
      if (posterior().family[f] >= 0.01) result_.effects.push_back({family(f).bound, posterior().family[f]});
    }
    std::stable_sort(result_.effects.begin(), result_.effects.end(),
                     [](const EffectProbability& a, const EffectProbability& b) { return a.p > b.p; });
    best_ = &posterior().sets[posterior().best];
    at_ = set_regression(problem(), posterior(), *best_);
    result_.gains_by_run = gains_by_run(problem(), posterior(), *best_, at_);
    const Covariance& covariance = posterior().points[best_->point].covariance;
    result_.noise = noise_of(covariance, at_.variance);
    describe_discrepancy();
    tell_what_was_not_used();
    for (Driver& driver : result_.drivers)
      driver.is_clear = !tuning().columns_not_searched || result_.columns_not_searched.empty();
    result_.detectability = detectability_by(result_.noise);
    add_own();
  }

  void describe_discrepancy() {
    const Eigen::VectorXd mean_um = discrepancy_mean(problem(), posterior(), *best_);
    result_.discrepancy_um = std::sqrt((mean_um.array() - mean_um.mean()).square().mean());
    if (result_.p_discrepancy < kDiscrepancy || !(result_.discrepancy_um > 0.0)) return;
    const Description like = description_of(options_.search.catalogue, problem(), mean_um);
    result_.discrepancy_like = like.effect;
    result_.discrepancy_parameter = like.parameter;
    result_.discrepancy_time_s = like.time_s;
  }

  void tell_what_was_not_used() {
    if (model_.level != Level::series) return;
    const auto rows = static_cast<double>(std::max<std::size_t>(1, problem().logged.series.time_s.size()));
    for (const LoggedInput& input : problem().logged.inputs) {
      if (!input.at_end.empty())
        result_.saturated.push_back({input.column, static_cast<double>(input.at_end.size()) / rows});
    }
    result_.set_aside = far_readings(find_column(data_, result_.target)->values).size();
    result_.level_jumps = problem().level_jumps.size();
    std::vector<double> sizes_um;
    for (const LevelJump& jump : problem().level_jumps) sizes_um.push_back(jump.size_um);
    if (!sizes_um.empty()) result_.level_jump_um = median(std::move(sizes_um));
    for (const Column& column : problem().logged.series.columns) {
      if (column.role == Role::measured || column.name.find("_sigma_") != std::string::npos) continue;
      const auto is_it = [&](const std::string& name) { return name == column.name; };
      const auto reads = [&](const auto& one) { return std::any_of(one.columns.begin(), one.columns.end(), is_it); };
      if (!may_drive(column.values) || std::any_of(model_.targets.begin(), model_.targets.end(), is_it) ||
          std::any_of(model_.not_inputs.begin(), model_.not_inputs.end(), is_it) ||
          std::any_of(model_.terms.begin(), model_.terms.end(), reads) ||
          std::any_of(problem().library.families.begin(), problem().library.families.end(),
                      [&](const Family& one) { return reads(one.bound); }))
        continue;
      const bool has_gaps =
          std::any_of(column.values.begin(), column.values.end(), [](double value) { return !std::isfinite(value); });
      result_.columns_not_searched.push_back({column.name, has_gaps});
    }
  }

  // Standard deviation of what the model cannot imitate of each member of the best set.
  std::vector<double> unimitated_um() const {
    const Variant& variant = posterior().variants[best_->variant];
    std::vector<Eigen::Index> free;
    for (std::size_t k = 0; k < variant.line.is_free.size(); ++k) {
      if (variant.line.is_free[k] != 0) free.push_back(static_cast<Eigen::Index>(k));
    }
    const Eigen::MatrixXd basis = orthonormal(Eigen::MatrixXd(at_.line(Eigen::all, free)));
    const Eigen::VectorXd coefficients =
        at_.white_columns().completeOrthogonalDecomposition().solve(at_.white_y).tail(at_.members.cols());
    std::vector<double> sizes_um;
    for (std::size_t m = 0; m < at_.first.size(); ++m) {
      const Eigen::VectorXd curve =
          at_.members.middleCols(at_.first[m], at_.width[m]) * coefficients.segment(at_.first[m], at_.width[m]);
      const Eigen::VectorXd left = orthogonal_part(curve, basis);
      sizes_um.push_back(std::sqrt(left.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, left.size()))));
    }
    return sizes_um;
  }

  // Beside a discrepancy the form of an effect cannot be told, and beside a larger one no cause (Brynjarsdottir and
  // O'Hagan 2014, Inverse Problems 30, 114007).
  double discrepancy_beside_um() const { return result_.p_discrepancy >= kDiscrepancy ? result_.discrepancy_um : 0.0; }

  void doubt_beside_discrepancy() {
    const double beside_um = discrepancy_beside_um();
    if (!(beside_um > 0.0)) return;
    const std::vector<double> seen_um = unimitated_um();
    std::set<std::string> clear;
    for (std::size_t m = 0; m < result_.candidates.size(); ++m) {
      Candidate& one = result_.candidates[m];
      const bool is_larger = seen_um[m] >= beside_um;
      if (is_larger) clear.insert(one.bound.columns.begin(), one.bound.columns.end());
      if (is_jump(*one.bound.effect)) continue;
      one.doubts.push_back(is_larger ? Doubt::drift_beside : Doubt::larger_drift);
    }
    for (Driver& driver : result_.drivers) driver.is_clear = driver.is_clear && clear.contains(driver.column);
  }

  void add_own() {
    for (std::size_t k = 0; k < problem().own.size(); ++k) {
      if (posterior().own[k] < 0.05) continue;
      const auto set = std::find_if(posterior().sets.begin(), posterior().sets.end(),
                                    [&](const EffectSet& one) { return one.own == k + 1; });
      if (set == posterior().sets.end()) continue;
      const FittedSet fitted = fitted_set(problem(), posterior(), *set, false);
      const std::size_t place = problem().own[k].parameter;
      const FittedParameter& parameter = fitted.parameters[place];
      result_.own.push_back({parameter.effect, parameter.name, parameter.unit, problem().own[k].held, parameter.value,
                             fitted.intervals[place], posterior().own[k]});
    }
  }

  // As in a fit of the model with these effects by `add` and `check`.
  double rmse_um_with(const FittedSet& fitted) const { return fit(fitted.model, data_, target_).rmse_um; }

  void test_members() {
    if (best_->families.empty()) {
      result_.rmse_after_um =
          best_->own > 0 ? rmse_um_with(fitted_set(problem(), posterior(), *best_, false)) : problem().base.rmse_um;
      return;
    }
    tell(fmt::format("testing {} effects", best_->families.size()));
    const FittedSet fitted = fitted_set(problem(), posterior(), *best_, true);
    result_.rmse_after_um = rmse_um_with(fitted);
    result_.explained_um = std::min(fitted.together_um, measured_um_);
    for (std::size_t m = 0; m < best_->signatures.size(); ++m) {
      Candidate one = tested_member(inference_, *best_, fitted, at_, m);
      one.in_best_set = true;
      one.minor = one.amplitude_um < std::max(kMinor * problem().base.rmse_um, options_.tolerance_um);
      if (!(one.likelihood_ratio >= kLeastLikelihoodRatio)) one.doubts.push_back(Doubt::weak_evidence);
      result_.candidates.push_back(std::move(one));
    }
    if (tuning().beside_discrepancy) doubt_beside_discrepancy();
    if (!options_.leave_out || model_.level != Level::series) return;
    tell("leaving cycles out");
    std::vector<std::size_t> terms(result_.candidates.size());
    std::iota(terms.begin(), terms.end(), model_.terms.size());
    leave_cycles_out(fitted.model, terms, data_, target_, result_.candidates);
  }

  // Whether a single effect is more likely an input in any form than an effect of the catalogue.
  bool is_of_any_form(std::size_t l) const {
    const std::vector<double>& p = posterior().effects[l].p;
    const auto first = p.begin() + static_cast<std::ptrdiff_t>(problem().effects),
               end = p.begin() + static_cast<std::ptrdiff_t>(problem().library.families.size());
    return std::accumulate(first, end, 0.0) > std::accumulate(p.begin(), first, 0.0);
  }

  void decide() {
    Diagnosis& d = result_;
    bool own_named = false, own_probable = false;
    const bool all_searched =
        !tuning().columns_not_searched || d.columns_not_searched.empty();  // else another cause may be among those
    const bool is_clear = !(tuning().beside_discrepancy && discrepancy_beside_um() > 0.0) && all_searched;
    for (const OwnValue& own : d.own) {
      own_named = own_named || (own.p >= kNamed && is_clear);
      own_probable = own_probable || (own.p >= kProbable && is_clear);
    }
    for (std::size_t m = 0; m < d.candidates.size(); ++m) {
      Candidate& one = d.candidates[m];
      if (one.doubts.empty() && one.p >= kNamed && all_searched) {
        d.named.push_back(one.bound);
      } else if (one.doubts.empty() && one.p >= kProbable) {
        d.probable.push_back(one.bound);
      } else {
        std::vector<BoundEffect> group;
        const std::size_t l = best_->single[m];
        for (const std::size_t i : credible_set(posterior().effects[l])) {
          if (i < problem().effects) group.push_back(family(i).bound);
        }
        if (std::find(group.begin(), group.end(), one.bound) == group.end()) group.push_back(one.bound);
        const bool is_reported = std::find(d.equivalent.begin(), d.equivalent.end(), group) != d.equivalent.end();
        one.other_form_likelier = is_of_any_form(l);
        if (!one.other_form_likelier && !is_reported) d.equivalent.push_back(std::move(group));
      }
    }
    const bool driver = model_.level == Level::series &&
                        std::any_of(d.drivers.begin(), d.drivers.end(),
                                    [&](const Driver& one) { return one.p >= kSureDriver && one.is_clear; });
    // More than the readings scatter, as far as their sigma is known: something is missing, without a cause here.
    const double stated_um = std::sqrt(problem().known.variance);
    const bool has_rest = stated_um > 0.0 && d.base.rmse_um > kRest * stated_um;
    if (d.p_nothing >= kNothing && d.level_jumps == 0) {
      d.named.clear();
      d.probable.clear();
      d.equivalent.clear();
      d.verdict = has_rest ? Verdict::unexplained : Verdict::nothing;
    } else if (!d.named.empty() || own_named) {
      d.verdict = Verdict::named;
    } else if (!d.probable.empty() || own_probable) {
      d.verdict = Verdict::probable;
    } else if (driver) {
      d.verdict = Verdict::driver;
    } else if (is_of_time_alone()) {
      d.verdict = Verdict::unexplained;
    } else {
      d.verdict = Verdict::equivalent;
    }
  }

  // Whether no possibly missing effect reads a column.
  bool is_of_time_alone() const {
    const auto goes_with_time = [](const BoundEffect& bound) { return bound.effect->time_only; };
    return std::all_of(result_.equivalent.begin(), result_.equivalent.end(),
                       [&](const auto& group) { return std::all_of(group.begin(), group.end(), goes_with_time); });
  }

  // After the best set the other probable effects, each with the rest of its own best set.
  void show_candidates() {
    for (const EffectProbability& effect : result_.effects) {
      if (result_.candidates.size() >= kMostShown) break;
      if (candidate_of(result_, effect.bound) != nullptr) continue;
      const std::size_t f = *family_of(problem(), effect.bound);
      const auto set = std::find_if(posterior().sets.begin(), posterior().sets.end(), [&](const EffectSet& one) {
        return std::find(one.families.begin(), one.families.end(), f) != one.families.end();
      });
      if (set == posterior().sets.end()) continue;
      const FittedSet fitted = fitted_set(problem(), posterior(), *set, false);
      const std::size_t m = member_of(inference_, *set, effect.bound);
      result_.candidates.push_back(described_member(inference_, *set, fitted, m));
    }
    for (const std::vector<BoundEffect>& group : result_.equivalent) {
      for (Candidate& candidate : result_.candidates) {
        if (std::find(group.begin(), group.end(), candidate.bound) == group.end()) continue;
        for (const BoundEffect& other : group) {
          if (!(other == candidate.bound)) candidate.inseparable_from.push_back(label_of(other));
        }
      }
    }
  }

  // Each effect by itself, as `add` fits it, so that the reported RMSE is the later one. This invalidates pointers into
  // the sets.
  void fit_candidates() {
    best_ = nullptr;
    for (std::size_t k = 0; k < result_.candidates.size(); ++k) {
      tell(fmt::format("fitting candidate {} of {}", k + 1, result_.candidates.size()));
      Candidate& one = result_.candidates[k];
      one.rmse_after_um = fit(model_with(inference_, model_, {term_of(problem(), one.bound)}), data_, target_).rmse_um;
    }
  }

  Inference& inference_;
  const Model& model_;
  const Series& data_;
  std::size_t target_;
  const DiagnosisOptions& options_;
  double measured_um_ = 0.0;  // largest less smallest reading
  const EffectSet* best_ = nullptr;
  SetRegression at_;
  Diagnosis result_;
};

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
  return Decision(inference, model, data, target, options).run();
}

Diagnosis diagnose(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options) {
  Inference found = inference_of(model, data, target, options);
  return diagnosis_of(found, model, data, target, options);
}

}  // namespace ballbar
