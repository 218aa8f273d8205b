#include "ballbar/revision/effect_test.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/fit/held_model.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/statistics/ml_noise_fit.hpp"
#include "diagnosis/verdict/named_tests.hpp"
#include "fit/machine_error_fit.hpp"
#include "numerics/tails.hpp"
#include "revision/ledger_row.hpp"
#include "revision/machine_error_test.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

constexpr std::uint64_t kSeed = 1;

std::size_t free_parameters(const Term& term) {
  return static_cast<std::size_t>(
      std::count_if(term.settings.begin(), term.settings.end(), [](const Setting& setting) { return !setting.held; }));
}

// The model without one of its terms, at its most likely: fitted anew, or from where the whole model is and by its
// noise, whichever is better.
NoiseFit noise_fit_without(const Model& model, const Series& data, std::size_t target, const NoiseFit& whole,
                           std::size_t term) {
  const auto drop = [&](Model rest) {
    rest.terms.erase(rest.terms.begin() + static_cast<std::ptrdiff_t>(term));
    return rest;
  };
  if (!has_free(drop(model))) {
    NoiseFit rest = whole;
    const std::vector<double>& added = whole.fit.contribution_um[term];
    rest.linearised.residual_um += Eigen::VectorXd::Map(added.data(), static_cast<Eigen::Index>(added.size()));
    rest.linearised.model.resize(rest.linearised.residual_um.size(), 0);
    const GlsFit explained_rest =
        gls_fit(rest.linearised, Eigen::MatrixXd(rest.linearised.residual_um.size(), 0), whole.noise);
    rest.noise = explained_rest.noise;
    rest.log_likelihood = explained_rest.log_likelihood;
    return rest;
  }
  NoiseFit rest = noise_fit_by(whole.noise, drop(from_where_it_is(model, whole.fit)), data, target);
  NoiseFit anew = noise_fit(drop(model), data, target);
  return anew.log_likelihood > rest.log_likelihood ? anew : rest;
}

// 2 ln L lost. The larger model is at least as likely, wherever the search for its shapes ended.
double likelihood_ratio_of(const NoiseFit& with, const NoiseFit& without) {
  return std::max(0.0, 2.0 * (with.log_likelihood - without.log_likelihood));
}

// Of the grid of its shapes; nullopt where it has no surrogates.
std::optional<BestSurrogate> surrogate_of(const WithAndWithout& models) {
  const Term& term = models.model.terms[models.term];
  const BoundEffect bound{term.effect.get(), term.columns};
  if (bound.effect->time_only || bound.effect->inputs.empty()) return std::nullopt;
  const BoundInputs inputs = inputs_of(*bound.effect, bound.columns, models.data);
  if (!inputs.usable) return std::nullopt;
  const bool of_recordings = bound.effect->level == Level::recording;
  return surrogate_of(models, bound,
                      of_recordings ? std::vector<std::vector<double>>{} : shapes_of(*bound.effect, inputs.rows, {}),
                      kSurrogates, kSeed);
}

// all: fitted to all rows.
Candidate tested(const Model& model, const Fit& all, const Series& data, std::size_t target, const NoiseFit& whole,
                 std::size_t place) {
  const NoiseFit without = noise_fit_without(model, data, target, whole, place);
  const WithAndWithout models{data, model, place, whole, without};
  const FoldTests tests = fold_tests(models);
  Candidate candidate = candidate_of(model, all, place);
  candidate.likelihood_ratio = likelihood_ratio_of(whole, without);
  candidate.threshold = kLeastLikelihoodRatio;
  candidate.p_same_gain = tests.p_same_gain;
  candidate.rmse_after_um = all.rmse_um;
  candidate.held_out_before_um = tests.before.rmse_um;
  candidate.held_out_after_um = tests.after.rmse_um;
  candidate.gain = gain_of(models);
  candidate = beside_surrogate(std::move(candidate), surrogate_of(models));
  const bool of_recordings = model.level == Level::recording;
  if (candidate.likelihood_ratio < kLeastLikelihoodRatio) candidate.doubts.emplace_back(kLowLikelihoodRatio);
  if (candidate.p_same_gain < kSameGain) candidate.doubts.push_back(gain_differs(of_recordings));
  if (!(candidate.held_out_after_um < candidate.held_out_before_um)) {
    candidate.doubts.push_back(not_predicted_better(of_recordings));
  }
  if (candidate.beats_surrogates && !*candidate.beats_surrogates) candidate.doubts.emplace_back(kSurrogateDoesAsWell);
  return candidate;
}

std::vector<DropTest> drop_tests(const Model& model, std::size_t count, const Series& data, std::size_t target,
                                 const NoiseFit& whole) {
  std::vector<DropTest> result;
  for (std::size_t t = 0; t < count; ++t) {
    const Term& term = model.terms[t];
    DropTest drop_test;
    drop_test.term = t;
    drop_test.label = label_of(term);
    drop_test.parameters = free_parameters(term);
    if (drop_test.parameters == 0 || term.effect->rules.is_base) continue;
    drop_test.likelihood_ratio = likelihood_ratio_of(whole, noise_fit_without(model, data, target, whole, t));
    drop_test.p = chi2_upper_tail(drop_test.likelihood_ratio, drop_test.parameters);
    drop_test.needed = drop_test.p < kDropTest;
    result.push_back(std::move(drop_test));
  }
  return result;
}

std::string verdict_of(const std::vector<Candidate>& added) {
  const auto any = [&](auto is) { return std::any_of(added.begin(), added.end(), is); };
  if (any([](const Candidate& one) { return !one.doubts.empty(); })) return "not supported";
  return any([](const Candidate& one) { return one.bound.effect->time_only; }) ? "time only" : "supported";
}

void tell_earlier(const std::vector<DropTest>& earlier, LedgerRow& row) {
  row.still_needed.clear();
  row.no_longer_needed.clear();
  for (const DropTest& drop_test : earlier)
    (drop_test.needed ? row.still_needed : row.no_longer_needed).push_back(drop_test.label);
}

}  // namespace

std::vector<DropTest> drop_tests(const Model& model, std::size_t count, const Series& data, std::size_t target) {
  if (is_of_machine_errors(model, data)) return machine_error_drop_tests(model, count, data);
  const Series seen = subsampled(data, model.targets.at(target), kMostTested);
  return drop_tests(model, count, seen, target, noise_fit(model, seen, target));
}

EffectTest effect_test(const Model& model, const std::vector<Term>& added, const Series& data, std::size_t target) {
  EffectTest result;
  result.model = model;
  result.model.terms.insert(result.model.terms.end(), added.begin(), added.end());
  if (is_of_machine_errors(result.model, data)) return machine_error_test(model, added, data, target);
  const Series seen = subsampled(data, model.targets.at(target), kMostTested);
  result.fit_before = fit(model, data, target);
  result.fit_after = fit(result.model, data, target);
  const NoiseFit base = noise_fit(model, seen, target);
  const NoiseFit whole = noise_fit(result.model, seen, target);
  result.before = row_of(result.fit_before, base);
  result.after = row_of(result.fit_after, whole);
  std::vector<std::string> changes;
  for (std::size_t t = model.terms.size(); t < result.model.terms.size(); ++t) {
    result.added.push_back(tested(result.model, result.fit_after, seen, target, whole, t));
    changes.push_back("+ " + result.added.back().label);
    const double fall = result.added.back().best_surrogate_fall;
    if (std::isfinite(fall) && !(result.after.best_surrogate_fall >= fall)) result.after.best_surrogate_fall = fall;
  }
  // Alone it is that of its own test, which looks for the smaller model from both sides.
  result.after.likelihood_ratio =
      added.size() == 1 ? result.added.front().likelihood_ratio : likelihood_ratio_of(whole, base);
  result.after.threshold = kLeastLikelihoodRatio * static_cast<double>(added.size());
  result.after.change = fmt::format("{}", fmt::join(changes, ", "));
  result.after.verdict = verdict_of(result.added);
  result.earlier = drop_tests(result.model, model.terms.size(), seen, target, whole);
  tell_earlier(result.earlier, result.after);
  return result;
}

Pruned pruned(EffectTest effect_test, const Series& data, std::size_t target) {
  Pruned result{std::move(effect_test), {}};
  EffectTest& now = result.effect_test;
  std::size_t earlier = now.model.terms.size() - now.added.size();
  std::vector<std::size_t> place(earlier);  // in the model before, of what is left of it
  for (std::size_t t = 0; t < earlier; ++t) place[t] = t;
  const Series seen = subsampled(data, now.model.targets.at(target), kMostTested);
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
  now.fit_after = fit(now.model, data, target, {.beside_all_errors = true});
  const LedgerRow figures = is_of_machine_errors(now.model, data)
                                ? machine_error_row(now.model, data, target)
                                : row_of(now.fit_after, noise_fit(now.model, seen, target));
  now.after.parameters = figures.parameters;
  now.after.rmse_um = figures.rmse_um;
  now.after.times_floor = figures.times_floor;
  now.after.held_out_um = figures.held_out_um;
  tell_earlier(now.earlier, now.after);
  return result;
}

}  // namespace ballbar
