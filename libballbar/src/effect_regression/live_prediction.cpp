#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/effect_regression/effect_regression.hpp"
#include "effect_regression/interval.hpp"
#include "effect_regression/ridge.hpp"

namespace ballbar {
namespace {

// Each effect for a gain of 1, so that a row gives what the covariance is of.
Model with_gains_of_1(Model model) {
  model.constant_um = 0.0;
  for (Term& term : model.terms) {
    bool is_first = true;
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      if (term.effect->parameters[k].kind != ParameterKind::gain) continue;
      term.settings[k].start = is_first ? 1.0 : 0.0;
      is_first = false;
    }
  }
  return model;
}

double first_gain(const Term& term) {
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (term.effect->parameters[k].kind == ParameterKind::gain) return term.settings[k].start;
  }
  return 0.0;
}

}  // namespace

LivePrediction::LivePrediction(const EffectRegression& regression)
    : of_(regression), live_(with_gains_of_1(regression.model)) {
  for (const Term& term : regression.model.terms) gains_.push_back(first_gain(term));
  contributions_um_.resize(gains_.size());
  scaled_.resize(static_cast<Eigen::Index>(gains_.size()) + 2);
  known_ = scaled_;
  for (const std::string& name : live_.columns()) {
    const auto range = std::find_if(regression.model.trained.begin(), regression.model.trained.end(),
                                    [&](const ColumnRange& one) { return one.column == name; });
    const ColumnRange wider = with_margin(*range);
    low_.push_back(wider.low);
    high_.push_back(wider.high);
  }
}

LivePrediction::At LivePrediction::next(double time_s, std::span<const double> values) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(live_.next(time_s, values))) return {kUnknown, kUnknown, false};
  const std::span<const double> units = live_.contributions_um();
  const auto m = static_cast<Eigen::Index>(gains_.size());
  At at;
  at.predicted_um = *of_.model.constant_um;
  scaled_[0] = 1.0;
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto i = static_cast<std::size_t>(k);
    contributions_um_[i] = gains_[i] * units[i];
    at.predicted_um += contributions_um_[i];
    scaled_[k + 1] = (units[i] - of_.mean_um[k]) / of_.sd_um[k];
  }
  const bool is_after = goes_on_ && of_.length_s > 0.0 && time_s > of_.end_s;
  scaled_[m + 1] = is_after ? std::exp(-(time_s - of_.end_s) / of_.length_s) : 0.0;
  discrepancy_um_ = of_.end_discrepancy_um * scaled_[m + 1];
  at.predicted_um += discrepancy_um_;
  known_.noalias() = of_.factor_um.triangularView<Eigen::Lower>().transpose() * scaled_;
  const double fresh = 1.0 - remembered(0.0, of_.length_s) * scaled_[m + 1] * scaled_[m + 1];
  at.half_width_um =
      kNormal95 * of_.interval_scale * std::sqrt(known_.squaredNorm() + fresh * of_.sigma_um * of_.sigma_um);
  for (std::size_t c = 0; c < values.size(); ++c)
    at.outside = at.outside || values[c] < low_[c] || values[c] > high_[c];
  return at;
}

void LivePrediction::go_on() { resume(of_.end, true); }

void LivePrediction::begin_training_again() {
  live_.begin_anew();
  goes_on_ = true;
}

void LivePrediction::resume(const LiveModel::State& state, bool since_end) {
  live_.resume(state);
  goes_on_ = since_end;
}

}  // namespace ballbar
