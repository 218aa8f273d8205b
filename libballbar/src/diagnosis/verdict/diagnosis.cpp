#include "ballbar/diagnosis/verdict/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "diagnosis/posterior/set_at.hpp"
#include "diagnosis/posterior/weighed.hpp"
#include "diagnosis/signatures/detectability.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "diagnosis/verdict/fitted_set.hpp"
#include "diagnosis/verdict/gains_by_run.hpp"
#include "diagnosis/verdict/probabilities.hpp"
#include "diagnosis/verdict/sentence.hpp"
#include "diagnosis/verdict/tested_member.hpp"
#include "fit/linearised_fit.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

// Nothing is said of effects that are not searched.
std::vector<Detectability> detectability_but(const SearchOptions& options, std::vector<Detectability> detectability) {
  const auto left_out = [&](const std::string& name) {
    return std::find(options.without.begin(), options.without.end(), name) != options.without.end();
  };
  std::erase_if(detectability, [&](const Detectability& one) { return left_out(one.effect->name); });
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
  Decision(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options,
           const std::vector<Covariance>& covariances)
      : model_(model), options_(options) {
    ProblemOptions how;
    how.covariances = covariances;
    how.catalogue = options.search.catalogue;
    how.signatures.motion = options.search.motion;
    how.signatures.without = options.search.without;
    how.most_rows = options.most_rows;
    weighed_ = weighed(model, data, target, how, {}, {options.search.progress, options.search.so_far});
    result_.base = problem().base;
    result_.target = problem().base.target;
    result_.where = options.where;
  }

  Diagnosis run() {
    std::set<const Effect*> searched;
    for (std::size_t f = 0; f < problem().effects; ++f) searched.insert(family(f).bound.effect);
    result_.searched_effects = searched.size();
    if (weighed_.is_still) return still();
    if (problem().effects == 0 || weighed_.largest == 0) return untestable(weighed_.largest == 0);
    read_posterior();
    test_members();
    decide();
    show_candidates();
    result_.sentence = sentence_of(result_);
    return std::move(result_);
  }

 private:
  const Problem& problem() const { return *weighed_.problem; }
  const Posterior& posterior() const { return weighed_.posterior; }
  const Family& family(std::size_t f) const { return problem().library.families[f]; }

  void tell(std::string_view step) const {
    if (options_.search.progress) options_.search.progress(step);
  }

  Diagnosis still() {
    result_.detectability = detectability_by(problem().base.noise);
    result_.smallest_um = std::numeric_limits<double>::infinity();
    result_.rmse_after_um = problem().base.rmse_um;
    result_.sentence = "The readings do not move: there is nothing to explain.";
    return std::move(result_);
  }

  Diagnosis untestable(bool too_few) {
    result_.verdict = Verdict::untestable;
    result_.noise = problem().base.noise;
    result_.detectability = detectability_by(problem().base.noise);
    result_.reasons.emplace_back(too_few ? "There are too few values to test anything more."
                                         : "No effect of the catalogue can be tested on these data.");
    result_.sentence = sentence_of(result_);
    return std::move(result_);
  }

  std::vector<Detectability> detectability_by(const Noise& noise) {
    const Fit& base = problem().base;
    const Eigen::VectorXd residual =
        Eigen::VectorXd::Map(base.residual_um.data(), static_cast<Eigen::Index>(base.residual_um.size()));
    const Projected seen =
        projected(problem().library, residual, model_columns(base), Whitening(noise, base.time_s, base.sigma_um));
    result_.smallest_um = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < problem().library.signatures.size(); ++i) {
      const std::size_t f = problem().library.signatures[i].family;
      if (f >= problem().effects || family(f).bound.effect->time_only) continue;
      const double um = detectable_um(problem().library, seen, i, kFound);
      if (um >= result_.smallest_um) continue;
      result_.smallest_um = um;
      result_.smallest = family(f).bound;
    }
    return detectability_but(options_.search,
                             detectability_of(options_.search.catalogue, problem().library, seen, model_,
                                              problem().logged.series, options_.search.motion));
  }

  void read_posterior() {
    p_ = probabilities_of(problem(), posterior());
    result_.p_nothing = p_.nothing;
    result_.p_discrepancy = p_.discrepancy;
    result_.log_bayes_factor = p_.log_bayes_factor;
    if (model_.level == Level::series) result_.drivers = drivers_of(posterior(), problem(), p_.column);
    for (std::size_t f = 0; f < problem().effects; ++f) {
      if (p_.family[f] >= 0.01) result_.effects.push_back({family(f).bound, p_.family[f]});
    }
    std::stable_sort(result_.effects.begin(), result_.effects.end(),
                     [](const EffectProbability& a, const EffectProbability& b) { return a.p > b.p; });
    best_ = &posterior().sets.front();
    at_ = set_at(problem(), posterior(), *best_);
    result_.gains_by_run = gains_by_run(problem(), posterior(), *best_, at_);
    const Covariance& covariance = posterior().points[best_->point].covariance;
    result_.noise = noise_of(covariance, at_.variance);
    for (const EffectSet& set : posterior().sets) {
      const Covariance& there = posterior().points[set.point].covariance;
      if (!(there.slow > 0.0)) continue;
      result_.discrepancy_um = std::sqrt(there.slow * set_at(problem(), posterior(), set).variance);
      break;
    }
    result_.detectability = detectability_by(result_.noise);
    add_own();
  }

  void add_own() {
    for (std::size_t k = 0; k < problem().own.size(); ++k) {
      if (p_.own[k] < 0.05) continue;
      const auto set = std::find_if(posterior().sets.begin(), posterior().sets.end(),
                                    [&](const EffectSet& one) { return one.own == k + 1; });
      const FittedSet fitted = fitted_set(problem(), posterior(), *set, false);
      const std::size_t place = problem().own[k].parameter;
      const FittedParameter& parameter = fitted.parameters[place];
      result_.own.push_back({parameter.effect, parameter.name, parameter.unit, problem().own[k].held, parameter.value,
                             fitted.intervals[place], p_.own[k]});
    }
  }

  void test_members() {
    if (best_->families.empty()) {
      result_.rmse_after_um =
          best_->own > 0 ? fitted_set(problem(), posterior(), *best_, false).rmse_um : problem().base.rmse_um;
      return;
    }
    tell(fmt::format("testing {} effects", best_->families.size()));
    const FittedSet fitted = fitted_set(problem(), posterior(), *best_, true);
    result_.rmse_after_um = fitted.rmse_um;
    for (std::size_t m = 0; m < best_->signatures.size(); ++m) {
      Candidate one = tested_member(weighed_, *best_, fitted, at_, m, options_.surrogates, options_.search.seed);
      one.in_best_set = true;
      one.minor = one.amplitude_um < std::max(kMinor * problem().base.rmse_um, options_.tolerance_um);
      if (one.bound.effect->time_only)
        one.doubts.emplace_back("it needs nothing but time, which imitates anything slow");
      if (one.amplitude_um > kCancelled * fitted.together_um)
        one.doubts.emplace_back("another effect of the set nearly cancels it");
      result_.candidates.push_back(std::move(one));
    }
  }

  void decide() {
    Diagnosis& d = result_;
    const bool sure = p_.discrepancy < kDiscrepancy;
    bool own_named = false, own_probable = false;
    for (const OwnValue& own : d.own) {
      own_named = own_named || (sure && own.p >= kNamed);
      own_probable = own_probable || (sure && own.p >= kProbable);
    }
    const std::vector<std::vector<std::size_t>> groups = groups_of(posterior(), *best_, p_.family);
    for (std::size_t m = 0; m < d.candidates.size(); ++m) {
      const Candidate& one = d.candidates[m];
      if (sure && one.doubts.empty() && one.p >= kNamed) {
        d.named.push_back(one.bound);
      } else if (sure && one.doubts.empty() && one.p >= kProbable) {
        d.probable.push_back(one.bound);
      } else {
        std::vector<BoundEffect> group;
        for (const std::size_t f : groups[m]) group.push_back(family(f).bound);
        d.equivalent.push_back(std::move(group));
      }
      for (const GainByRun& gain : d.gains_by_run) {
        if (gain.effect == one.label)
          d.reasons.push_back(fmt::format("{}: its gain differs from run to run.", one.label));
      }
      for (const std::string& doubt : one.doubts) d.reasons.push_back(fmt::format("{}: {}.", one.label, doubt));
    }
    if (p_.discrepancy >= kDiscrepancy) {
      d.reasons.push_back(fmt::format("A slow curve without any cause is left, P = {:.2f}.", p_.discrepancy));
    }
    const bool driver = model_.level == Level::series &&
                        std::any_of(d.drivers.begin(), d.drivers.end(),
                                    [&](const Driver& one) { return one.p >= kSureDriver && is_shown(one.column); });
    if (d.p_nothing > kNothing) {
      d.named.clear();
      d.probable.clear();
      d.equivalent.clear();
      d.verdict = Verdict::nothing;
    } else if (!d.named.empty() || own_named) {
      d.verdict = Verdict::named;
    } else if (!d.probable.empty() || own_probable) {
      d.verdict = Verdict::probable;
    } else if (driver) {
      d.verdict = Verdict::driver;
    } else if (p_.discrepancy >= kDiscrepancy || p_.time_alone >= 0.5 || best_->families.empty()) {
      d.verdict = Verdict::unexplained;
    } else {
      d.verdict = Verdict::equivalent;
    }
  }

  // Whether some effect of the best set that reads it predicts cycles left out, and better than a curve without cause.
  bool is_shown(const std::string& column) const {
    return std::any_of(result_.candidates.begin(), result_.candidates.end(), [&](const Candidate& one) {
      const std::vector<std::string>& columns = one.bound.columns;
      return std::find(columns.begin(), columns.end(), column) != columns.end() &&
             one.held_out_evidence >= kHeldOutEvidence && one.beats_surrogates.value_or(true) &&
             one.likelihood_ratio >= kLeastLikelihoodRatio;
    });
  }

  // Behind the best set what else is probable, beside the rest of its own best set.
  void show_candidates() {
    for (const EffectProbability& effect : result_.effects) {
      if (result_.candidates.size() >= kMostShown) break;
      if (std::any_of(result_.candidates.begin(), result_.candidates.end(),
                      [&](const Candidate& one) { return one.bound == effect.bound; }))
        continue;
      std::size_t f = 0;
      while (!(family(f).bound == effect.bound)) ++f;
      const auto set = std::find_if(posterior().sets.begin(), posterior().sets.end(), [&](const EffectSet& one) {
        return std::find(one.families.begin(), one.families.end(), f) != one.families.end();
      });
      const FittedSet fitted = fitted_set(problem(), posterior(), *set, false);
      std::size_t m = 0;
      while (problem().library.signatures[set->signatures[m]].family != f) ++m;
      Candidate one = described_member(weighed_, *set, fitted, m);
      result_.candidates.push_back(std::move(one));
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

  const Model& model_;
  const DiagnosisOptions& options_;
  Weighed weighed_;
  Probabilities p_;
  const EffectSet* best_ = nullptr;
  SetAt at_;
  Diagnosis result_;
};

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::named:
      return "named";
    case Verdict::probable:
      return "probable";
    case Verdict::driver:
      return "driver";
    case Verdict::equivalent:
      return "equivalent";
    case Verdict::unexplained:
      return "unexplained";
    case Verdict::untestable:
      return "untestable";
    case Verdict::nothing:
      return "nothing";
  }
  return "nothing";
}

Diagnosis diagnose(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options) {
  return diagnosis_at(model, data, target, options, {});
}

Diagnosis diagnosis_at(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options,
                       const std::vector<Covariance>& covariances) {
  return Decision(model, data, target, options, covariances).run();
}

}  // namespace ballbar
