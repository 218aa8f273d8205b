#include "diagnosis/statistics/likely.hpp"

#include <algorithm>

#include "series/cycles.hpp"

namespace ballbar {
namespace {

constexpr int kMostRounds = 8;
constexpr double kWorthAnotherRound = 0.01;  // ln L

Likely likely_of(const Fit& fit, const Series& data) {
  Likely result{leftover_of(fit), {}, 0.0, cycles_of(data, fit.row), recording_numbers(data) != nullptr};
  const Explained rest = explained(result.leftover, Eigen::MatrixXd(result.leftover.residual_um.size(), 0), fit.noise);
  result.noise = rest.noise;
  result.log_likelihood = rest.log_likelihood;
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

Seen seen_by(const Noise& noise, const Model& model, const Series& data, std::size_t target) {
  FitOptions options;
  options.noise = noise;
  Seen result;
  result.fit = fit(model, data, target, options);
  result.likely = likely_of(result.fit, data);
  return result;
}

Seen seen_of(const Model& model, const Series& data, std::size_t target) {
  Seen best;
  best.fit = fit(model, data, target);
  best.likely = likely_of(best.fit, data);
  for (int round = 0; round < kMostRounds; ++round) {
    Seen again = seen_by(best.likely.noise, from_where_it_is(model, best.fit), data, target);
    const double gained = again.likely.log_likelihood - best.likely.log_likelihood;
    if (gained > 0.0) best = std::move(again);
    if (!(gained > kWorthAnotherRound)) break;
  }
  return best;
}

}  // namespace ballbar
