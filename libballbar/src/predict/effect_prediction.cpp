// What a regression on effects predicts: row by row, and of a series.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/predict/batch.hpp"
#include "ballbar/predict/effect_regression.hpp"
#include "numerics/not_finite.hpp"
#include "predict/driver_report.hpp"
#include "predict/ridge.hpp"

namespace ballbar {
namespace {

constexpr double kMostStepsApart = 10;  // between the end of training and what goes on from it

// Whether the series has the first and the last row of the last training run: machines that start cold begin alike.
bool holds_training(const EffectRegression& regression, const Series& series,
                    const std::vector<const Column*>& columns) {
  const LiveModel::State& end = regression.end;
  if (end.rows == 0) return false;
  for (const std::size_t kept : {std::size_t{0}, end.rows - 1}) {
    const auto at = std::lower_bound(series.time_s.begin(), series.time_s.end(), end.time_s[kept]);
    if (at == series.time_s.end() || *at != end.time_s[kept]) return false;
    if (kept == 0 && at != series.time_s.begin()) return false;
    const auto row = static_cast<std::size_t>(at - series.time_s.begin());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (columns[c]->values[row] != end.inputs[c * end.time_s.size() + kept]) return false;
    }
  }
  return true;
}

bool goes_on(const EffectRegression& regression, const Series& series) {
  const LiveModel::State& end = regression.end;
  if (end.rows == 0 || series.time_s.empty()) return false;
  const double since_s = series.time_s.front() - end.time_s[end.rows - 1];
  return since_s > 0.0 && since_s <= kMostStepsApart * regression.end_step_s;
}

// Shares of the range of the prediction, the largest first; the columns of `drivers_um` in their order.
void add_shares(RegressionPrediction& prediction) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < prediction.predicted_um.size(); ++i) {
    if (std::isfinite(prediction.predicted_um[i])) rows.push_back(i);
  }
  if (rows.empty()) return;
  const Eigen::MatrixXd known = prediction.drivers_um(rows, Eigen::all);
  const Eigen::VectorXd sum = known.rowwise().sum();
  const Eigen::VectorXd share = shares_of(known, sum);
  for (std::size_t d = 0; d < prediction.drivers.size(); ++d)
    prediction.drivers[d].share_um = share[static_cast<Eigen::Index>(d)];
  std::vector<std::size_t> order(prediction.drivers.size());
  for (std::size_t d = 0; d < order.size(); ++d) order[d] = d;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(prediction.drivers[a].share_um) > std::abs(prediction.drivers[b].share_um);
  });
  prediction.drivers_um = prediction.drivers_um(Eigen::all, order).eval();
  std::vector<DriverShare> sorted;
  sorted.reserve(order.size());
  for (const std::size_t d : order) sorted.push_back(prediction.drivers[d]);
  prediction.drivers = std::move(sorted);
}

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

RegressionPrediction predict(const EffectRegression& regression, const Series& series,
                             const std::optional<PredictionState>& from) {
  LivePrediction live(regression);
  std::vector<const Column*> columns;
  for (const std::string& name : live.columns()) columns.push_back(&column_of(series, name));
  RegressionPrediction prediction;
  prediction.holds = !from && holds_training(regression, series, columns);
  prediction.goes_on = from || (!prediction.holds && goes_on(regression, series));
  if (from) {
    live.resume(from->live, from->since_end);
  } else if (prediction.goes_on) {
    live.go_on();
  } else if (prediction.holds) {
    live.begin_training_again();
  }
  std::vector<Eigen::Index> driver_of;  // of every term
  for (const Term& term : regression.model.terms) {
    const std::string& name = term.columns.front();
    const auto known = std::find_if(prediction.drivers.begin(), prediction.drivers.end(),
                                    [&](const DriverShare& one) { return one.column == name; });
    driver_of.push_back(known - prediction.drivers.begin());
    if (known != prediction.drivers.end()) continue;
    const auto range = std::find_if(regression.model.trained.begin(), regression.model.trained.end(),
                                    [&](const ColumnRange& one) { return one.column == name; });
    prediction.drivers.push_back(
        {name, regression.roles[static_cast<std::size_t>(range - regression.model.trained.begin())], 0.0});
  }
  const std::size_t n = series.time_s.size();
  prediction.drivers_um.setZero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(prediction.drivers.size()));
  prediction.predicted_um.resize(n);
  prediction.half_width_um.resize(n);
  std::vector<double> values(columns.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < columns.size(); ++c) values[c] = columns[c]->values[i];
    const LivePrediction::At at = live.next(series.time_s[i], values);
    prediction.predicted_um[i] = at.predicted_um;
    prediction.half_width_um[i] = at.half_width_um;
    if (!std::isfinite(at.predicted_um)) continue;
    const std::span<const double> each = live.contributions_um();
    for (std::size_t t = 0; t < each.size(); ++t)
      prediction.drivers_um(static_cast<Eigen::Index>(i), driver_of[t]) += each[t];
  }
  prediction.end = {live.state(), live.goes_on()};
  for (const ColumnRange& range : regression.model.trained) {
    const auto outside = outside_of(range, find_column(series, range.column)->values, series.time_s);
    if (outside) prediction.outside.push_back(*outside);
  }
  add_shares(prediction);
  return prediction;
}

}  // namespace ballbar
