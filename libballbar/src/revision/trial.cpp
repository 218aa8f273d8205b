#include "ballbar/revision/trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

#include "diagnosis/signatures/bank.hpp"
#include "diagnosis/statistics/confirmation.hpp"
#include "diagnosis/statistics/held_out.hpp"
#include "diagnosis/statistics/likely.hpp"
#include "diagnosis/surrogates/fakes.hpp"
#include "diagnosis/surrogates/trace_fakes.hpp"
#include "numerics/not_finite.hpp"
#include "series/cycles.hpp"
#include "series/thinned.hpp"

namespace ballbar {
namespace {

constexpr std::uint64_t kSeed = 1;

std::size_t free_parameters(const Term& term) {
  return static_cast<std::size_t>(
      std::count_if(term.settings.begin(), term.settings.end(), [](const Setting& setting) { return !setting.held; }));
}

bool has_free(const Model& model) {
  if (model.level == Level::series && !model.constant_um) return true;
  return std::any_of(model.terms.begin(), model.terms.end(),
                     [](const Term& term) { return free_parameters(term) > 0; });
}

// What tests look at.
struct Tested {
  const Series& data;
  std::size_t target;
  Fit fit;
  Likely likely;
};

Tested tested(const Model& model, const Series& data, std::size_t target) {
  Seen seen = seen_of(model, data, target);
  return {data, target, std::move(seen.fit), std::move(seen.likely)};
}

// The model without one of its terms, at its most likely: fitted anew, or from where the whole model is and by its
// noise, whichever is better.
Likely likely_without(const Model& model, const Tested& whole, std::size_t term) {
  const auto drop = [&](Model rest) {
    rest.terms.erase(rest.terms.begin() + static_cast<std::ptrdiff_t>(term));
    return rest;
  };
  if (!has_free(drop(model))) {
    Likely rest = whole.likely;
    const std::vector<double>& added = whole.fit.contribution_um[term];
    rest.leftover.residual_um += Eigen::VectorXd::Map(added.data(), static_cast<Eigen::Index>(added.size()));
    rest.leftover.model.resize(rest.leftover.residual_um.size(), 0);
    const Explained explained_rest =
        explained(rest.leftover, Eigen::MatrixXd(rest.leftover.residual_um.size(), 0), whole.likely.noise);
    rest.noise = explained_rest.noise;
    rest.log_likelihood = explained_rest.log_likelihood;
    return rest;
  }
  const Model from_there = drop(from_where_it_is(model, whole.fit));
  Seen rest = seen_by(whole.likely.noise, from_there, whole.data, whole.target);
  Seen anew = seen_of(drop(model), whole.data, whole.target);
  return anew.likely.log_likelihood > rest.likely.log_likelihood ? anew.likely : rest.likely;
}

// 2 ln L lost. The larger model is at least as likely, wherever the search for its shapes ended.
double evidence_of(const Likely& with, const Likely& without) {
  return std::max(0.0, 2.0 * (with.log_likelihood - without.log_likelihood));
}

// Chance of a chi^2 as large.
double upper_tail(double chi2, std::size_t degrees) {
  return chi2 > 0.0 ? Eigen::numext::igammac(0.5 * static_cast<double>(degrees), 0.5 * chi2) : 1.0;
}

// The model's fakes of one of its terms; nothing where it cannot be faked.
std::optional<BestFake> fake_of(const Model& model, std::size_t place, const Tested& whole, const Likely& without) {
  const Term& term = model.terms[place];
  const Effect& effect = *term.effect;
  if (effect.time_only || effect.inputs.empty()) return std::nullopt;
  const BoundInputs inputs = inputs_of(effect, term.columns, whole.data);
  if (!inputs.usable) return std::nullopt;
  if (effect.level == Level::recording) {
    TracedEffect traced{&effect, term.columns, {{}}, {}};
    const std::size_t first = first_parameter(model, place);
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      traced.points.front().push_back(whole.fit.parameters[first + k].value);
    }
    const std::vector<double>& added = whole.fit.contribution_um[place];
    traced.added_um = Eigen::VectorXd::Map(added.data(), static_cast<Eigen::Index>(added.size()));
    return best_trace_fake(traced, whole.data, whole.fit.row, without.leftover, whole.likely.noise, kFakes, kSeed);
  }
  Bank bank;
  for (std::vector<double>& point : shapes_of(effect, inputs.rows, {})) {
    Signature signature;
    signature.point = std::move(point);
    bank.signatures.push_back(std::move(signature));
  }
  if (bank.signatures.empty()) return std::nullopt;
  const Family family{&effect, term.columns, 0, bank.signatures.size()};
  return best_fake(family, bank, whole.data, without.leftover, whole.likely.noise, kFakes, kSeed);
}

Tried tried_of(const Model& model, const Fit& all, const Tested& whole, std::size_t place) {
  const Term& term = model.terms[place];
  Tried tried;
  tried.label = label_of(term);
  tried.time_only = term.effect->time_only;
  const auto [low, high] = std::minmax_element(all.contribution_um[place].begin(), all.contribution_um[place].end());
  tried.amplitude_um = *high - *low;
  double relative = kUnknown;
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const FittedParameter& fitted = all.parameters[first_parameter(model, place) + k];
    if (term.effect->parameters[k].kind != ParameterKind::gain || fitted.value == 0.0) continue;
    if (!std::isfinite(fitted.sigma)) continue;
    const double one = std::abs(fitted.sigma / fitted.value);
    relative = std::isfinite(relative) ? std::min(relative, one) : one;
  }
  tried.amplitude_sigma_um = relative * tried.amplitude_um;
  const Likely without = likely_without(model, whole, place);
  tried.evidence = evidence_of(whole.likely, without);
  const Eigen::MatrixXd gains = gain_columns(whole.fit, model, place);
  const std::vector<std::size_t> told = cycles_that_tell(whole.data, whole.fit.row, whole.likely.cycle, gains);
  tried.p_same_gain = p_same_gain(whole.likely.leftover, gains, whole.likely.noise, told);
  tried.held_out_um = held_out(without.leftover, whole.likely.noise, told, whole.likely.of_recordings).rmse_um;
  const double held_out_with_um =
      held_out(whole.likely.leftover, whole.likely.noise, told, whole.likely.of_recordings).rmse_um;
  tried.gain = chi2(without.leftover, whole.likely.noise) - chi2(whole.likely.leftover, whole.likely.noise);
  if (const std::optional<BestFake> fake = fake_of(model, place, whole, without)) {
    tried.best_fake_gain = fake->gain;
    tried.best_fake_fall = fake->fall;
  }
  if (tried.evidence < kFewestEvidence) tried.doubts.emplace_back("its evidence is below 25 (d = 5)");
  const bool of_recordings = model.level == Level::recording;
  if (tried.p_same_gain < kSameGain) {
    tried.doubts.emplace_back(of_recordings ? "its gain differs from recording to recording"
                                            : "its gain differs from cycle to cycle");
  }
  if (!(held_out_with_um < tried.held_out_um)) {
    tried.doubts.emplace_back(of_recordings ? "recordings left out are not predicted better"
                                            : "cycles left out are not predicted better");
  }
  if (tried.best_fake_gain >= tried.gain) tried.doubts.emplace_back("a fake of the same smoothness does as well");
  return tried;
}

std::vector<Stay> stays(const Model& model, std::size_t count, const Tested& whole) {
  std::vector<Stay> result;
  for (std::size_t t = 0; t < count; ++t) {
    const Term& term = model.terms[t];
    Stay stay;
    stay.term = t;
    stay.label = label_of(term);
    stay.parameters = free_parameters(term);
    if (stay.parameters == 0 || term.effect->rules.is_base) continue;
    stay.evidence = evidence_of(whole.likely, likely_without(model, whole, t));
    stay.p = upper_tail(stay.evidence, stay.parameters);
    stay.needed = stay.p < kStays;
    result.push_back(std::move(stay));
  }
  return result;
}

std::string verdict_of(const std::vector<Tried>& added) {
  const auto any = [&](auto is) { return std::any_of(added.begin(), added.end(), is); };
  if (any([](const Tried& tried) { return !tried.doubts.empty(); })) return "not supported";
  return any([](const Tried& tried) { return tried.time_only; }) ? "time only" : "supported";
}

void tell_earlier(const std::vector<Stay>& earlier, LedgerRow& row) {
  row.still_needed.clear();
  row.no_longer_needed.clear();
  for (const Stay& stay : earlier) (stay.needed ? row.still_needed : row.no_longer_needed).push_back(stay.label);
}

}  // namespace

std::vector<Stay> stays(const Model& model, std::size_t count, const Series& data, std::size_t target) {
  const Series seen = thinned(data, model.targets.at(target), kMostTested);
  return stays(model, count, tested(model, seen, target));
}

Trial trial(const Model& model, const std::vector<Term>& added, const Series& data, std::size_t target) {
  const Series seen = thinned(data, model.targets.at(target), kMostTested);
  Trial result;
  result.model = model;
  result.model.terms.insert(result.model.terms.end(), added.begin(), added.end());
  result.fit_before = fit(model, data, target);
  result.fit_after = fit(result.model, data, target);
  const Tested base = tested(model, seen, target);
  const Tested whole = tested(result.model, seen, target);
  result.before = row_of(result.fit_before, base.likely);
  result.after = row_of(result.fit_after, whole.likely);
  std::vector<std::string> changes;
  for (std::size_t t = model.terms.size(); t < result.model.terms.size(); ++t) {
    result.added.push_back(tried_of(result.model, result.fit_after, whole, t));
    changes.push_back("+ " + result.added.back().label);
    const double fall = result.added.back().best_fake_fall;
    if (std::isfinite(fall) && !(result.after.best_fake_fall >= fall)) result.after.best_fake_fall = fall;
  }
  // Alone it is that of its own test, which looks for the smaller model from both sides.
  result.after.evidence = added.size() == 1 ? result.added.front().evidence : evidence_of(whole.likely, base.likely);
  result.after.threshold = kFewestEvidence * static_cast<double>(added.size());
  result.after.change = fmt::format("{}", fmt::join(changes, ", "));
  result.after.verdict = verdict_of(result.added);
  result.earlier = stays(result.model, model.terms.size(), whole);
  tell_earlier(result.earlier, result.after);
  return result;
}

Pruned pruned(Trial trial, const Series& data, std::size_t target) {
  Pruned result{std::move(trial), {}};
  Trial& now = result.trial;
  std::size_t earlier = now.model.terms.size() - now.added.size();
  std::vector<std::size_t> place(earlier);  // in the model before, of what is left of it
  for (std::size_t t = 0; t < earlier; ++t) place[t] = t;
  const Series seen = thinned(data, now.model.targets.at(target), kMostTested);
  while (true) {
    const auto least = std::max_element(now.earlier.begin(), now.earlier.end(),
                                        [](const Stay& a, const Stay& b) { return a.p < b.p; });
    if (least == now.earlier.end() || least->needed) break;
    now.after.change += ", - " + least->label;
    const auto at = static_cast<std::ptrdiff_t>(least->term);
    now.model.terms.erase(now.model.terms.begin() + at);
    result.removed.push_back(place[least->term]);
    place.erase(place.begin() + at);
    now.earlier = stays(now.model, --earlier, data, target);
  }
  std::sort(result.removed.begin(), result.removed.end());
  if (result.removed.empty()) return result;
  now.fit_after = fit(now.model, data, target);
  const LedgerRow figures = row_of(now.fit_after, seen_of(now.model, seen, target).likely);
  now.after.parameters = figures.parameters;
  now.after.rmse_um = figures.rmse_um;
  now.after.times_floor = figures.times_floor;
  now.after.held_out_um = figures.held_out_um;
  tell_earlier(now.earlier, now.after);
  return result;
}

}  // namespace ballbar
