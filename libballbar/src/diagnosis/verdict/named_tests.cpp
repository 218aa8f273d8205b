#include "diagnosis/verdict/named_tests.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/numerics/range.hpp"
#include "diagnosis/statistics/gain_tests.hpp"
#include "diagnosis/surrogates/surrogate_recordings.hpp"
#include "series/folds.hpp"

namespace ballbar {

Candidate candidate_of(const Model& model, const Fit& fit, std::size_t place) {
  const Term& term = model.terms[place];
  Candidate candidate;
  candidate.bound = {term.effect.get(), term.columns};
  candidate.label = label_of(term);
  const std::size_t first = first_parameter(model, place);
  double relative = Candidate::kUnknown;
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const FittedParameter& fitted = fit.parameters[first + k];
    candidate.parameters.push_back(fitted);
    if (term.effect->parameters[k].kind != ParameterKind::gain || fitted.value == 0.0) continue;
    const double one = std::abs(fitted.sigma / fitted.value);
    relative = std::isfinite(relative) ? std::min(relative, one) : one;
  }
  candidate.amplitude_um = range_of(fit.contribution_um[place]);
  candidate.amplitude_sigma_um = relative * candidate.amplitude_um;
  return candidate;
}

CycleTests cycle_tests(const WithAndWithout& models) {
  const auto& [data, model, term, with, without] = models;
  const Eigen::MatrixXd gains = gain_columns(with.fit, model, term);
  const std::vector<std::size_t> told = cycles_that_tell(data, with.fit.row, with.cycle, gains);
  CycleTests tests;
  tests.p_same_gain = p_same_gain(with.leftover, gains, with.noise, told);
  tests.before = held_out(without.leftover, with.noise, told, with.of_recordings);
  tests.after = held_out(with.leftover, with.noise, told, with.of_recordings);
  tests.in_one_cycle = share_of_one_cycle(without.leftover, gains, with.noise, told);
  tests.gain_of_many = gain_of_many(without.leftover, gains, with.noise);
  return tests;
}

double gain_of(const WithAndWithout& models) {
  return chi2(models.without.leftover, models.with.noise) - chi2(models.with.leftover, models.with.noise);
}

std::optional<BestFake> fake_of(const WithAndWithout& models, const BoundEffect& bound,
                                std::vector<std::vector<double>> points, std::size_t count, std::uint64_t seed) {
  const auto& [data, model, term, with, without] = models;
  FakedEffect faked{bound, std::move(points), {}};
  if (bound.effect->level == Level::series) {
    if (faked.points.empty()) return std::nullopt;
    return best_fake(faked, data, without.leftover, with.noise, count, seed);
  }
  std::vector<double> fitted;
  const std::size_t first = first_parameter(model, term);
  for (std::size_t k = 0; k < bound.effect->parameters.size(); ++k) {
    fitted.push_back(with.fit.parameters[first + k].value);
  }
  faked.points.insert(faked.points.begin(), std::move(fitted));
  const std::vector<double>& added = with.fit.contribution_um[term];
  faked.added_um = Eigen::VectorXd::Map(added.data(), static_cast<Eigen::Index>(added.size()));
  return best_trace_fake(faked, data, with.fit.row, without.leftover, with.noise, count, seed);
}

Candidate beside_fake(Candidate candidate, const std::optional<BestFake>& fake) {
  if (!fake) return candidate;
  candidate.best_fake_gain = fake->gain;
  candidate.best_fake_fall = fake->fall;
  candidate.beats_fakes = candidate.gain > fake->gain;
  return candidate;
}

std::string gain_differs(bool of_recordings) {
  return of_recordings ? "its gain differs from recording to recording" : "its gain differs from cycle to cycle";
}

std::string not_predicted_better(bool of_recordings) {
  return of_recordings ? "recordings left out are not predicted better" : "cycles left out are not predicted better";
}

}  // namespace ballbar
