#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/error.hpp"
#include "ballbar/revision/revision.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "diagnosis/verdict/member_tests.hpp"
#include "diagnosis/verdict/start_values.hpp"
#include "fit/machine_error_fit.hpp"
#include "model/bindings.hpp"
#include "revision/effect_test_parts.hpp"

namespace ballbar {
namespace {

std::size_t free_parameters(const Term& term) {
  return static_cast<std::size_t>(
      std::count_if(term.settings.begin(), term.settings.end(), [](const Setting& setting) { return !setting.held; }));
}

// An effect that the model can produce: it adds nothing of its own.
Candidate untestable_candidate(const BoundEffect& bound) {
  Candidate one;
  one.bound = bound;
  one.label = label_of(bound);
  one.doubts.push_back(Doubt::in_the_model);
  return one;
}

// The label of an effect of time alone holds the shape that was tried.
void relabel(std::vector<FittedParameter>& parameters, const std::string& from, const std::string& to) {
  for (FittedParameter& parameter : parameters) {
    if (parameter.effect == from) parameter.effect = to;
  }
}

// The set beside whose other members and freed value the effects of `alone` are tested, as diagnose() tests them: the
// most probable set if it has them all, else the most probable one that has and frees nothing. `alone` if the search
// found none.
const EffectSet& set_with(const Posterior& posterior, const EffectSet& alone) {
  const auto has_them = [&](const EffectSet& set) {
    return set.log_weight > kLogZero &&
           std::includes(set.families.begin(), set.families.end(), alone.families.begin(), alone.families.end());
  };
  const EffectSet& best = posterior.sets[posterior.best];
  if (has_them(best)) return best;
  const auto listed = std::find_if(posterior.sets.begin(), posterior.sets.end(),
                                   [&](const EffectSet& set) { return !set.freed && has_them(set); });
  return listed == posterior.sets.end() ? alone : *listed;
}

// Fills `added`, `parameters`, and the figures of `after` that the posterior has.
void test_added(Inference& found, const std::vector<Term>& terms, const Series& data, std::size_t target,
                EffectTest& result) {
  const std::vector<BoundEffect> bounds = bounds_of(terms);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto first = static_cast<std::size_t>(std::find(bounds.begin(), bounds.end(), bounds[t]) - bounds.begin());
    if (first != t)
      throw Error(fmt::format("{} and {}: expected an effect once in a revision; add one, then the other",
                              label_of(terms[first]), label_of(terms[t])));
  }
  const EffectSet* alone = set_of_all(found, bounds);
  if (alone == nullptr) {
    for (const BoundEffect& bound : bounds) result.added.push_back(untestable_candidate(bound));
    if (!found.posterior.sets.empty()) result.after.likelihood_ratio = 0.0;  // else the readings are still, or too few
    return;
  }
  const EffectSet& set = set_with(found.posterior, *alone);
  std::vector<std::size_t> others;
  std::set_difference(set.families.begin(), set.families.end(), alone->families.begin(), alone->families.end(),
                      std::back_inserter(others));
  for (const std::size_t family : others)
    result.beside.push_back(label_of(found.problem->library.families[family].bound));
  result.after.likelihood_ratio = log_bayes_factor_beside(found, set, others);
  const FittedSet fitted = fitted_set(*found.problem, found.posterior, set, true);
  if (others.empty() && !set.freed) result.parameters = fitted.parameters;
  if (set.freed) {
    const FittedParameter& freed = fitted.parameters[found.problem->held[*set.freed].parameter];
    result.freed = FreedParameter{freed.effect, freed.name};
  }
  const SetRegression at = set_regression(*found.problem, found.posterior, set);
  std::vector<std::size_t> places;  // in the fitted model
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const std::size_t m = member_of(found, set, bounds[t]);
    places.push_back(found.problem->model.terms.size() + m);
    Candidate one = tested_member(found, set, fitted, at, m);
    one.label = label_of(terms[t]);
    relabel(one.parameters, one.parameters.front().effect, one.label);
    relabel(result.parameters, label_of(fitted.model.terms[places.back()]), one.label);
    result.added.push_back(std::move(one));
  }
  if (result.model.level == Level::series) leave_cycles_out(fitted.model, places, data, target, result.added);
}

std::string verdict_of(const std::vector<Candidate>& added) {
  const auto any = [&](auto is) { return std::any_of(added.begin(), added.end(), is); };
  if (any([](const Candidate& one) { return !one.doubts.empty(); })) return std::string(kNotSupported);
  return any([](const Candidate& one) { return one.bound.effect->time_only; }) ? "time only" : "supported";
}

void tell_earlier(const std::vector<DropTest>& earlier, LedgerRow& row) {
  row.still_needed.clear();
  row.no_longer_needed.clear();
  for (const DropTest& drop_test : earlier)
    (drop_test.needed ? row.still_needed : row.no_longer_needed).push_back(drop_test.label);
}

}  // namespace

// As the catalogue has it, nothing held or started elsewhere, on columns that a search looks at. A search looks at no
// effect of time alone but a jump.
bool is_usual(const Term& term, const Model& model, const Series& data) {
  const Effect* effect = find_effect(term.effect->name, term.effect->level);
  if (effect == nullptr) return false;
  if (effect->level == Level::series && effect->time_only && !is_jump(*effect)) return false;
  const Term usual = term_of(*effect, term.columns);
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const Setting &one = term.settings[k], &other = usual.settings[k];
    if (one.held != other.held || one.start != other.start || one.stated) return false;
    if (one.lower != other.lower || one.upper != other.upper) return false;
  }
  const std::vector<std::vector<std::string>> bindings = bindings_of(*effect, model, data);
  return std::find(bindings.begin(), bindings.end(), term.columns) != bindings.end();
}

std::vector<DropTest> drop_tests(const Model& model, std::size_t count, const Series& data, std::size_t target) {
  if (is_of_machine_errors(model, data)) return machine_error_drop_tests(model, count, data);
  DiagnosisOptions it_alone;
  it_alone.search.catalogue.clear();
  std::vector<DropTest> result;
  for (std::size_t t = 0; t < count; ++t) {
    const Term& term = model.terms[t];
    DropTest drop_test;
    drop_test.term = t;
    drop_test.label = label_of(term);
    drop_test.parameters = free_parameters(term);
    if (drop_test.parameters == 0 || term.effect->rules.is_base) continue;
    Inference found = inference_of(model_without(model, t), data, target, it_alone, {term});
    if (const EffectSet* set = set_of_all(found, bounds_of({term}))) {
      drop_test.likelihood_ratio = log_bayes_factor_of_member(found, *set, 0);
    }
    drop_test.p = 1.0 / (1.0 + std::exp(0.5 * drop_test.likelihood_ratio));
    drop_test.needed = drop_test.p < kDropTest;
    result.push_back(std::move(drop_test));
  }
  return result;
}

EffectTest effect_test_of(Inference& found, FittedModel before, FittedModel after, std::size_t count,
                          const Series& data, std::size_t target) {
  EffectTest result;
  result.model = std::move(after.model);
  result.fit_before = std::move(before.fit);
  result.fit_after = std::move(after.fit);
  result.before = std::move(before.row);
  result.after = std::move(after.row);
  const std::vector<Term>& terms = result.model.terms;
  const std::vector<Term> added(terms.end() - static_cast<std::ptrdiff_t>(count), terms.end());
  test_added(found, added, data, target, result);
  std::vector<std::string> changes;
  for (Candidate& one : result.added) {
    one.rmse_after_um = result.fit_after.rmse_um;
    changes.push_back("+ " + one.label);
  }
  result.after.threshold = kLeastLikelihoodRatio * static_cast<double>(count);
  result.after.change = fmt::format("{}", fmt::join(changes, ", "));
  result.after.verdict = verdict_of(result.added);
  result.earlier = drop_tests(result.model, terms.size() - count, data, target);
  tell_earlier(result.earlier, result.after);
  return result;
}

Pruned pruned(EffectTest effect_test, const Series& data, std::size_t target) {
  Pruned result{std::move(effect_test), {}};
  EffectTest& now = result.effect_test;
  std::size_t earlier = now.model.terms.size() - now.added.size();
  std::vector<std::size_t> place(earlier);  // in the model before, of those that remain
  for (std::size_t t = 0; t < earlier; ++t) place[t] = t;
  while (true) {
    const auto least = std::max_element(now.earlier.begin(), now.earlier.end(),
                                        [](const DropTest& a, const DropTest& b) { return a.p < b.p; });
    if (least == now.earlier.end() || least->needed) break;
    now.after.change += ", - " + least->label;
    const auto at = static_cast<std::ptrdiff_t>(least->term);
    now.model.terms.erase(now.model.terms.begin() + at);
    result.removed.push_back(place[least->term]);
    place.erase(place.begin() + at);
    now.earlier = drop_tests(now.model, --earlier, data, target);
  }
  std::sort(result.removed.begin(), result.removed.end());
  if (result.removed.empty()) return result;
  now.parameters.clear();
  now.fit_after = fit(now.model, data, target, {.among_all_errors = true});
  const LedgerRow figures = is_of_machine_errors(now.model, data) ? machine_error_row(now.model, data, target)
                                                                  : row_of(now.fit_after, now.model, data, target);
  now.after.parameters = figures.parameters;
  now.after.rmse_um = figures.rmse_um;
  now.after.times_floor = figures.times_floor;
  now.after.held_out_um = figures.held_out_um;
  tell_earlier(now.earlier, now.after);
  return result;
}

}  // namespace ballbar
