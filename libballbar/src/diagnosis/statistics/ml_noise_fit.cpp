#include "diagnosis/statistics/ml_noise_fit.hpp"

#include <algorithm>
#include <utility>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "series/folds.hpp"

namespace ballbar {
namespace {

NoiseFit noise_fit_of(Fit fit, const Series& data) {
  NoiseFit result;
  result.linearised = linearised_fit_of(fit);
  result.fold = folds_of(data, fit.row);
  result.of_recordings = recording_numbers(data) != nullptr;
  const GlsFit rest = gls_fit(result.linearised, Eigen::MatrixXd(result.linearised.residual_um.size(), 0), fit.noise);
  result.noise = rest.noise;
  result.log_likelihood = rest.log_likelihood;
  result.fit = std::move(fit);
  return result;
}

}  // namespace

Model from_where_it_is(Model model, const Fit& fit) {
  std::size_t parameter = 1;  // the constant comes first
  for (Term& term : model.terms) {
    for (Setting& setting : term.settings) {
      const double value = fit.parameters[parameter++].value;
      if (setting.held) continue;
      setting.start = std::clamp(value, setting.lower, setting.upper);
      setting.stated = true;
    }
  }
  return model;
}

NoiseFit noise_fit_by(const Noise& noise, const Model& model, const Series& data, std::size_t target) {
  FitOptions options;
  options.noise = noise;
  return noise_fit_of(fit(model, data, target, options), data);
}

NoiseFit noise_fit(const Model& model, const Series& data, std::size_t target) {
  NoiseFit best = noise_fit_of(fit(model, data, target), data);
  for (int round = 0; round < kFitsByNoise; ++round) {
    NoiseFit again = noise_fit_by(best.noise, from_where_it_is(model, best.fit), data, target);
    const double gained = again.log_likelihood - best.log_likelihood;
    if (gained > 0.0) best = std::move(again);
    if (!(gained > kWorthAnotherRound)) break;
  }
  return best;
}

}  // namespace ballbar
