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

FoldTests fold_tests(const WithAndWithout& models) {
  const auto& [data, model, term, with, without] = models;
  const Eigen::MatrixXd gains = gain_columns(with.fit, model, term);
  const std::vector<std::size_t> told = folds_that_tell(data, with.fit.row, with.fold, gains);
  FoldTests tests;
  tests.p_same_gain = p_same_gain(with.linearised, gains, with.noise, told);
  tests.before = cross_validation(without.linearised, with.noise, told, with.of_recordings);
  tests.after = cross_validation(with.linearised, with.noise, told, with.of_recordings);
  tests.in_one_fold = share_of_one_fold(without.linearised, gains, with.noise, told);
  tests.gain_of_many = gain_of_many(without.linearised, gains, with.noise);
  return tests;
}

double gain_of(const WithAndWithout& models) {
  return chi2(models.without.linearised, models.with.noise) - chi2(models.with.linearised, models.with.noise);
}

std::optional<BestSurrogate> surrogate_of(const WithAndWithout& models, const BoundEffect& bound,
                                          std::vector<std::vector<double>> points, std::size_t count,
                                          std::uint64_t seed) {
  const auto& [data, model, term, with, without] = models;
  SurrogateSource source{bound, std::move(points), {}};
  if (bound.effect->level == Level::series) {
    if (source.points.empty()) return std::nullopt;
    return best_surrogate(source, data, without.linearised, with.noise, count, seed);
  }
  std::vector<double> fitted;
  const std::size_t first = first_parameter(model, term);
  for (std::size_t k = 0; k < bound.effect->parameters.size(); ++k) {
    fitted.push_back(with.fit.parameters[first + k].value);
  }
  source.points.insert(source.points.begin(), std::move(fitted));
  const std::vector<double>& added = with.fit.contribution_um[term];
  source.added_um = Eigen::VectorXd::Map(added.data(), static_cast<Eigen::Index>(added.size()));
  return best_recording_surrogate(source, data, with.fit.row, without.linearised, with.noise, count, seed);
}

Candidate beside_surrogate(Candidate candidate, const std::optional<BestSurrogate>& surrogate) {
  if (!surrogate) return candidate;
  candidate.best_surrogate_gain = surrogate->gain;
  candidate.best_surrogate_fall = surrogate->fall;
  candidate.beats_surrogates = candidate.gain > surrogate->gain;
  return candidate;
}

std::string gain_differs(bool of_recordings) {
  return of_recordings ? "its gain differs from recording to recording" : "its gain differs from cycle to cycle";
}

std::string not_predicted_better(bool of_recordings) {
  return of_recordings ? "recordings left out are not predicted better" : "cycles left out are not predicted better";
}

}  // namespace ballbar
