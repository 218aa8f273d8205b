#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/batches/batch.hpp"
#include "ballbar/effect_regression/effect_regression.hpp"
#include "effect_regression/driver_report.hpp"
#include "effect_regression/interval.hpp"

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

void add_outside(const ColumnRange& range, const Column& column, const Series& series,
                 std::vector<OutsideRange>& outside) {
  const ColumnRange wider = with_margin(range);
  OutsideRange one{column.name, 0.0, range.low, range.high, 0.0, 0};
  double farthest = 0.0;
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    const double beyond = std::max(wider.low - column.values[i], column.values[i] - wider.high);
    if (!(beyond > 0.0)) continue;
    if (one.rows++ == 0) one.time_s = series.time_s[i];
    if (beyond > farthest) {
      farthest = beyond;
      one.value = column.values[i];
    }
  }
  if (one.rows > 0) outside.push_back(std::move(one));
}

// Shares of the range of the prediction, the largest first; the columns of `drivers_um` in their order.
void add_shares(EffectPrediction& prediction) {
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

}  // namespace

EffectPrediction predict(const EffectRegression& regression, const Series& series,
                         const std::optional<PredictionState>& from) {
  LivePrediction live(regression);
  std::vector<const Column*> columns;
  for (const std::string& name : live.columns()) columns.push_back(&column_of(series, name));
  EffectPrediction prediction;
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
    add_outside(range, *find_column(series, range.column), series, prediction.outside);
  }
  add_shares(prediction);
  return prediction;
}

}  // namespace ballbar
