#include "history/calls.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/units.hpp"
#include "history/robust_fit.hpp"

namespace ballbar {
namespace {

std::vector<Call> calls_in(std::size_t series, const SeriesJudgement& judgement) {
  std::vector<Call> calls;
  const auto add = [&](FindingKind kind, const std::optional<double>& p, const StepPlace& place) {
    if (p) calls.push_back({series, kind, *p, 1.0, place});
  };
  add(FindingKind::step, judgement.p_step, judgement.step);
  add(FindingKind::trend, judgement.p_trend, {});
  add(FindingKind::season, judgement.p_season, {});
  add(FindingKind::instrument, judgement.p_bar, {judgement.bar_at, judgement.bar_at, judgement.bar_at});
  return calls;
}

// The larger q of the two corrections: among all, and of the machine among the machines.
void correct(const AllSeries& all, std::vector<Call>& calls) {
  std::vector<double> p_values;
  std::vector<std::vector<double>> of_machine(all.machines.size());
  for (const Call& call : calls) {
    p_values.push_back(call.p_value);
    of_machine[all.series[call.series].machine].push_back(call.p_value);
  }
  const std::vector<double> q = q_values(p_values);
  std::vector<double> machine_p;
  machine_p.reserve(of_machine.size());
  for (std::vector<double>& p : of_machine) machine_p.push_back(simes(std::move(p)));
  const std::vector<double> machine_q = q_values(machine_p);
  for (std::size_t i = 0; i < calls.size(); ++i) {
    calls[i].q_value = std::max(q[i], machine_q[all.series[calls[i].series].machine]);
  }
}

FitColumns columns_of(const QuantitySeries& series, const Call& call) {
  if (call.kind == FindingKind::trend) return trend_columns(series.time_s).rightCols(1);
  if (call.kind == FindingKind::season) return season_columns(series.time_s);
  return step_column(series.value.size(), call.place.at);
}

double mean_of(const Eigen::VectorXd& values, std::size_t from, std::size_t to) {
  return values.segment(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to - from)).mean();
}

// By the sigmas of the fits alone.
double sigma_of_mean(const std::vector<double>& sigma) {
  double squares = 0.0;
  for (const double one : sigma) squares += one * one;
  return std::sqrt(squares) / static_cast<double>(sigma.size());
}

}  // namespace

std::vector<Call> calls_of(const AllSeries& all, const Scatter& scatter) {
  std::vector<std::vector<Call>> parts(all.series.size());
  in_parallel(parts.size(), [&](std::size_t i) {
    const QuantitySeries& series = all.series[i];
    parts[i] = calls_in(i, judgement_of(series, scatter.series[i], scatter.families[series.family]));
  });
  std::vector<Call> calls;
  for (const std::vector<Call>& part : parts) calls.insert(calls.end(), part.begin(), part.end());
  correct(all, calls);
  return calls;
}

SeriesCurve curve_with(const QuantitySeries& series, const SeriesScatter& scatter, const FamilyScatter& family,
                       const std::vector<Call*>& calls) {
  const std::size_t n = series.value.size();
  FitColumns columns = trend_columns(series.time_s).leftCols(1);
  std::vector<Eigen::Index> first;
  for (const Call* call : calls) {
    const FitColumns own = columns_of(series, *call);
    first.push_back(columns.cols());
    if (columns.cols() + own.cols() > kMostColumns) {
      first.back() = -1;
      continue;
    }
    columns = joined(columns, own);
  }
  const double s = scatter.s > 0.0 ? scatter.s : 1.0;
  const RobustFit fit = robust_fit(columns, series.value, scatters_of(series, s));
  const double memory = family.memory_beyond(static_cast<double>(n) / 4.0);
  const Eigen::VectorXd fitted = columns * fit.gains;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    Call& call = *calls[i];
    const Eigen::Index k = first[i];
    if (k < 0) continue;
    call.size = fit.gains[k];
    call.sigma = std::sqrt(memory * fit.covariance(k, k));
    if (call.kind == FindingKind::season) {
      call.size = std::hypot(fit.gains[k], fit.gains[k + 1]);
      call.sigma = std::sqrt(0.5 * memory * (fit.covariance(k, k) + fit.covariance(k + 1, k + 1)));
      // a sin x + b cos x is largest where tan x = a / b
      const double turns = std::atan2(fit.gains[k], fit.gains[k + 1]) / (2.0 * kPi);
      call.peak_year = turns - std::floor(turns);
    } else if (call.kind != FindingKind::trend) {
      call.before = mean_of(fitted, 0, call.place.at);
      call.after = mean_of(fitted, call.place.at, n);
    }
  }
  SeriesCurve curve;
  curve.fitted.assign(fitted.begin(), fitted.end());
  curve.level = curve.fitted.back();
  const Eigen::VectorXd last = columns.row(columns.rows() - 1).transpose();
  curve.sigma = scatter.s > 0.0 ? std::sqrt(memory * last.dot(fit.covariance * last)) : sigma_of_mean(series.sigma);
  return curve;
}

std::vector<double> q_values(std::span<const double> p_values) {
  const std::size_t n = p_values.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t left, std::size_t right) {
    return p_values[left] < p_values[right] || (p_values[left] == p_values[right] && left < right);
  });
  std::vector<double> q(n, 1.0);
  double least = 1.0;
  for (std::size_t rank = n; rank-- > 0;) {
    least = std::min(least, p_values[order[rank]] * static_cast<double>(n) / static_cast<double>(rank + 1));
    q[order[rank]] = least;
  }
  return q;
}

double simes(std::vector<double> p_values) {
  std::sort(p_values.begin(), p_values.end());
  double least = 1.0;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    least = std::min(least, p_values[i] * static_cast<double>(p_values.size()) / static_cast<double>(i + 1));
  }
  return least;
}

}  // namespace ballbar
