// What a regression on effects predicts: row by row, and of a series.
#include <algorithm>
#include <cmath>

#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/predict/train.hpp"
#include "numerics/not_finite.hpp"
#include "predict/driver_report.hpp"
#include "predict/ridge.hpp"

namespace ballbar {
namespace {

constexpr double kMostStepsApart = 10;        // between the end of training and what goes on from it
constexpr std::size_t kRowsTogether = 16384;  // what they give for gains of 1 takes 8 bytes a term and row

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
  const bool all = rows.size() == prediction.predicted_um.size();  // of a long series a copy costs
  const Eigen::MatrixXd some = all ? Eigen::MatrixXd() : Eigen::MatrixXd(prediction.drivers_um(rows, Eigen::all));
  const Eigen::MatrixXd& known = all ? prediction.drivers_um : some;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(known.rows());
  for (Eigen::Index d = 0; d < known.cols(); ++d) sum += known.col(d);
  const Eigen::VectorXd share = shares_of(known, sum);
  for (std::size_t d = 0; d < prediction.drivers.size(); ++d)
    prediction.drivers[d].share_um = share[static_cast<Eigen::Index>(d)];
  std::vector<std::size_t> order = rows_between(0, prediction.drivers.size());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(prediction.drivers[a].share_um) > std::abs(prediction.drivers[b].share_um);
  });
  Eigen::PermutationMatrix<Eigen::Dynamic> place(static_cast<Eigen::Index>(order.size()));
  std::vector<DriverShare> sorted;
  for (const std::size_t d : order) {
    place.indices()[static_cast<Eigen::Index>(sorted.size())] = static_cast<int>(d);
    sorted.push_back(prediction.drivers[d]);
  }
  prediction.drivers_um.applyOnTheRight(place);
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

// Those that have no finite value are left out of what comes after them.
void one_by_one(LivePrediction& live, const LivePrediction::Rows& rows) {
  Eigen::Ref<Eigen::MatrixXd> drivers_um = rows.drivers_um;
  std::vector<double> values(rows.values.size());
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) {
    for (std::size_t c = 0; c < values.size(); ++c) values[c] = rows.values[c][i];
    const LivePrediction::At at = live.next(rows.time_s[i], values);
    rows.predicted_um[i] = at.predicted_um;
    rows.half_width_um[i] = at.half_width_um;
    if (!std::isfinite(at.predicted_um)) continue;
    const std::span<const double> each = live.contributions_um();
    for (std::size_t t = 0; t < each.size(); ++t)
      drivers_um(static_cast<Eigen::Index>(i), live.driver_of_term()[t]) += each[t];
  }
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
  for (const Term& term : regression.model.terms) {
    gains_.push_back(first_gain(term));
    const auto known = std::find(drivers_.begin(), drivers_.end(), term.columns.front());
    driver_of_.push_back(known - drivers_.begin());
    if (known == drivers_.end()) drivers_.push_back(term.columns.front());
  }
  mean_um_.assign(regression.mean_um.begin(), regression.mean_um.end());
  for (const double sd_um : regression.sd_um) per_sd_.push_back(1.0 / sd_um);
  contributions_um_.resize(gains_.size());
  scaled_.setOnes(static_cast<Eigen::Index>(gains_.size() + 2));
  room_ = scaled_;
  for (const std::string& name : live_.columns()) {
    const auto range = std::find_if(regression.model.trained.begin(), regression.model.trained.end(),
                                    [&](const ColumnRange& one) { return one.column == name; });
    const ColumnRange wider = with_margin(*range);
    low_.push_back(wider.low);
    high_.push_back(wider.high);
  }
}

// The remaining share of the discrepancy at the end of training: 1 to 0.
double LivePrediction::forgotten(double time_s) const {
  const bool is_after = goes_on_ && of_.length_s > 0.0 && time_s > of_.end_s;
  return is_after ? std::exp(-(time_s - of_.end_s) / of_.length_s) : 0.0;
}

// scaled: 1, then each term in its own standard deviations, then the share of the discrepancy that is remembered.
double LivePrediction::half_width_um(const Eigen::Ref<const Eigen::VectorXd>& scaled, Eigen::VectorXd& room) const {
  room.noalias() = of_.factor_um.triangularView<Eigen::Lower>().transpose() * scaled;
  const double known_um2 = room.squaredNorm(), forgotten = scaled[scaled.size() - 1];
  const double fresh = 1.0 - remembered(0.0, of_.length_s) * forgotten * forgotten;
  return kNormal95 * of_.interval_scale * std::sqrt(known_um2 + fresh * of_.sigma_um * of_.sigma_um);
}

LivePrediction::At LivePrediction::next(double time_s, std::span<const double> values) {
  if (!std::isfinite(live_.next(time_s, values))) return {kUnknown, kUnknown, false};
  const std::span<const double> units = live_.contributions_um();
  At at;
  at.predicted_um = *of_.model.constant_um;
  for (std::size_t k = 0; k < gains_.size(); ++k) {
    contributions_um_[k] = gains_[k] * units[k];
    at.predicted_um += contributions_um_[k];
    scaled_[static_cast<Eigen::Index>(k + 1)] = (units[k] - mean_um_[k]) * per_sd_[k];
  }
  double& left = scaled_[scaled_.size() - 1];
  left = forgotten(time_s);
  discrepancy_um_ = of_.end_discrepancy_um * left;
  at.predicted_um += discrepancy_um_;
  at.half_width_um = half_width_um(scaled_, room_);
  for (std::size_t c = 0; c < values.size(); ++c)
    at.outside = at.outside || values[c] < low_[c] || values[c] > high_[c];
  return at;
}

bool LivePrediction::next(const Rows& rows) {
  constexpr std::size_t kRowsOfPart = 256;
  const std::size_t n = rows.time_s.size(), m = gains_.size();
  units_.resize(n * m);
  if (!live_.next(rows.time_s, rows.values, units_)) return false;
  Eigen::Ref<Eigen::MatrixXd> drivers_um = rows.drivers_um;
  in_parallel((n + kRowsOfPart - 1) / kRowsOfPart, [&](std::size_t part) {
    const std::size_t begin = part * kRowsOfPart, count = std::min(kRowsOfPart, n - begin);
    Eigen::MatrixXd scaled(scaled_.size(), static_cast<Eigen::Index>(count));  // a column for each row
    Eigen::VectorXd room(scaled_.size());
    double* const predicted_um = rows.predicted_um.data() + begin;
    std::fill_n(predicted_um, count, *of_.model.constant_um);
    scaled.row(0).setOnes();
    for (std::size_t k = 0; k < m; ++k) {
      const double* const units = units_.data() + k * n + begin;
      double* const driver_um = drivers_um.col(driver_of_[k]).data() + begin;
      for (std::size_t row = 0; row < count; ++row) {
        const double added_um = gains_[k] * units[row];
        predicted_um[row] += added_um;
        driver_um[row] += added_um;
        scaled(static_cast<Eigen::Index>(k + 1), static_cast<Eigen::Index>(row)) =
            (units[row] - mean_um_[k]) * per_sd_[k];
      }
    }
    for (std::size_t row = 0; row < count; ++row) {
      auto of_row = scaled.col(static_cast<Eigen::Index>(row));
      of_row[of_row.size() - 1] = forgotten(rows.time_s[begin + row]);
      predicted_um[row] += of_.end_discrepancy_um * of_row[of_row.size() - 1];
      rows.half_width_um[begin + row] = half_width_um(of_row, room);
    }
  });
  return true;
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
  for (const std::string& name : live.drivers()) {
    const auto range = std::find_if(regression.model.trained.begin(), regression.model.trained.end(),
                                    [&](const ColumnRange& one) { return one.column == name; });
    prediction.drivers.push_back(
        {name, regression.roles[static_cast<std::size_t>(range - regression.model.trained.begin())], 0.0});
  }
  const std::size_t n = series.time_s.size();
  prediction.drivers_um.setZero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(prediction.drivers.size()));
  prediction.predicted_um.resize(n);
  prediction.half_width_um.resize(n);
  for (std::size_t begin = 0; begin < n; begin += kRowsTogether) {
    const std::size_t count = std::min(kRowsTogether, n - begin);
    LivePrediction::Rows rows{
        {series.time_s.data() + begin, count},
        {},
        {prediction.predicted_um.data() + begin, count},
        {prediction.half_width_um.data() + begin, count},
        prediction.drivers_um.middleRows(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(count))};
    for (const Column* column : columns) rows.values.emplace_back(column->values.data() + begin, count);
    if (!live.next(rows)) one_by_one(live, rows);
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
