#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "diagnosis/verdict/start_values.hpp"
#include "fit/machine_error_fit.hpp"
#include "machine_errors/error_ranks.hpp"
#include "revision/effect_test_parts.hpp"

namespace ballbar {
namespace {

constexpr double kDropTestOfErrors = 0.001;  // p of chi^2, the same of errors of the axes

struct Errors {
  JointErrorFit fitted;
  std::vector<RankedError> ranked;
};

Errors errors_of(const Series& data) {
  Errors errors{joint_error_fit(data, MachineErrorOptions{}), {}};
  errors.ranked = ranked_errors(errors.fitted, error_table(errors.fitted, CyclicOfRuns::larger));
  return errors;
}

const RankedError* ranked_of(const Errors& errors, const Effect* effect) {
  const auto at = std::find_if(errors.ranked.begin(), errors.ranked.end(),
                               [&](const RankedError& one) { return one.effect == effect; });
  return at == errors.ranked.end() ? nullptr : &*at;
}

std::set<const Effect*> effects_of(const Model& model) {
  std::set<const Effect*> effects;
  for (const Term& term : model.terms) {
    if (!term.effect->rules.is_base) effects.insert(term.effect.get());
  }
  return effects;
}

LedgerRow row_of_errors(const Model& model, const Fit& fit, const Errors& errors) {
  LedgerRow row;
  row.level = Level::recording;
  row.target = fit.target;
  row.parameters = static_cast<std::size_t>(
      std::count_if(fit.parameters.begin(), fit.parameters.end(),
                    [](const FittedParameter& parameter) { return parameter.state == ParameterState::free; }));
  row.rmse_um = fit.rmse_um;
  if (fit.floor.rms_um > 0.0) row.times_floor = fit.rmse_um / fit.floor.rms_um;
  row.held_out_um = held_out_rms_um(errors.fitted, effects_of(model));
  return row;
}

Candidate candidate_of_error(const Model& model, std::size_t place, const Fit& all, const Errors& errors,
                             double held_out_before_um, double held_out_after_um) {
  const Term& term = model.terms[place];
  Candidate candidate;
  candidate.bound = {term.effect.get(), term.columns};
  candidate.label = label_of(term);
  for (const FittedParameter& parameter : all.parameters) {
    if (parameter.effect == candidate.label) candidate.parameters.push_back(parameter);
  }
  candidate.rmse_after_um = all.rmse_um;
  candidate.held_out_before_um = held_out_before_um;
  candidate.held_out_after_um = held_out_after_um;
  candidate.p_same_gain = Candidate::kUnknown;
  const RankedError* ranked = ranked_of(errors, term.effect.get());
  if (ranked == nullptr) {
    candidate.threshold = Candidate::kUnknown;
    candidate.doubts.push_back(Doubt::not_shown);
    return candidate;
  }
  candidate.likelihood_ratio = ranked->chi2;
  candidate.threshold = ranked->chi2_needed;
  candidate.amplitude_um = ranked->individual_circularity_um;
  candidate.amplitude_sigma_um =
      ranked->chi2 > 0.0 ? candidate.amplitude_um / std::sqrt(ranked->chi2) : Candidate::kUnknown;
  if (!ranked->significant) candidate.doubts.push_back(Doubt::not_significant);
  if (ranked->predicts_other_run == false) candidate.doubts.push_back(Doubt::not_predictive);
  return candidate;
}

std::vector<DropTest> drop_tests_of(const Model& model, std::size_t count, const Errors& errors) {
  std::vector<DropTest> tests;
  for (std::size_t t = 0; t < count; ++t) {
    const Term& term = model.terms[t];
    const RankedError* ranked = ranked_of(errors, term.effect.get());
    if (term.effect->rules.is_base || ranked == nullptr) continue;
    DropTest test;
    test.term = t;
    test.label = label_of(term);
    test.parameters = gains_of(*term.effect).size();
    test.likelihood_ratio = ranked->chi2;
    test.p = ranked->p_value;
    test.needed = test.p < kDropTestOfErrors;
    tests.push_back(std::move(test));
  }
  return tests;
}

}  // namespace

EffectTest machine_error_test(const Model& model, const std::vector<Term>& added, const Series& data,
                              std::size_t target) {
  const Errors errors = errors_of(data);
  EffectTest result;
  result.model = model;
  result.model.terms.insert(result.model.terms.end(), added.begin(), added.end());
  result.fit_before = fit_of_machine_errors(model, data, target, errors.fitted);
  result.fit_after = fit_of_machine_errors(result.model, data, target, errors.fitted);
  result.before = row_of_errors(model, result.fit_before, errors);
  result.after = row_of_errors(result.model, result.fit_after, errors);
  result.after.likelihood_ratio = 0.0;
  result.after.threshold = 0.0;
  std::vector<std::string> changes;
  for (std::size_t t = model.terms.size(); t < result.model.terms.size(); ++t) {
    const double held_out_um = held_out_rms_um(errors.fitted, effects_of(model_without(result.model, t)));
    result.added.push_back(
        candidate_of_error(result.model, t, result.fit_after, errors, held_out_um, result.after.held_out_um));
    changes.push_back("+ " + result.added.back().label);
    result.after.likelihood_ratio += result.added.back().likelihood_ratio;
    result.after.threshold += result.added.back().threshold;
  }
  result.after.change = fmt::format("{}", fmt::join(changes, ", "));
  const bool doubted =
      std::any_of(result.added.begin(), result.added.end(), [](const Candidate& one) { return !one.doubts.empty(); });
  result.after.verdict = doubted ? kNotSupported : "supported";
  result.earlier = drop_tests_of(result.model, model.terms.size(), errors);
  for (const DropTest& test : result.earlier) {
    (test.needed ? result.after.still_needed : result.after.no_longer_needed).push_back(test.label);
  }
  return result;
}

std::vector<DropTest> machine_error_drop_tests(const Model& model, std::size_t count, const Series& data) {
  return drop_tests_of(model, count, errors_of(data));
}

LedgerRow machine_error_row(const Model& model, const Series& data, std::size_t target) {
  const Errors errors = errors_of(data);
  return row_of_errors(model, fit_of_machine_errors(model, data, target, errors.fitted), errors);
}

}  // namespace ballbar
