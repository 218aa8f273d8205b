#include "predict/forecasts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/series/speed_steps.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestRows = 60, kOrigins = 3;

constexpr double kLeastSigma_um = 1e-6;  // of a target that stands still

double sigmas(const ForecastError& of) { return std::abs(of.error_um) / std::max(of.sigma_um, kLeastSigma_um); }

double mean_of(const std::vector<ForecastError>& errors, const auto& of_row) {
  double sum = 0.0, weights = 0.0;
  for (const ForecastError& one : errors) {
    sum += one.weight * of_row(one);
    weights += one.weight;
  }
  return sum / weights;
}

double rms_of(const std::vector<ForecastError>& errors, double ForecastError::*um) {
  return std::sqrt(mean_of(errors, [&](const ForecastError& one) { return one.*um * (one.*um); }));
}

// The first rows of the runs, as far as these rows of the design go; runs without one are left out.
std::vector<Series> runs_until(const Design& design, std::span<const Series> runs,
                               const std::vector<std::size_t>& from) {
  std::vector<std::size_t> end(runs.size(), 0);
  for (const std::size_t row : from) end[design.run[row]] = design.row[row] + 1;
  std::vector<Series> result;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (end[r] > 0) result.push_back(rows_of(runs[r], {0, end[r]}));
  }
  return result;
}

// Rows of the design that a forecast is of, from those before.
std::vector<RowRange> forecast_rows(const Design& design, const Series& run) {
  const std::size_t n = design.row.size();
  if (n < kFewestRows) return {};
  std::vector<std::size_t> changes;
  const auto speed = std::find_if(run.columns.begin(), run.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  if (speed != run.columns.end()) {
    for (const SpeedStep& step : speed_steps(run.time_s, *speed)) {
      const auto at = std::lower_bound(design.row.begin(), design.row.end(), step.begin);
      const auto row = static_cast<std::size_t>(at - design.row.begin());
      if (2 * row >= n && row < n && (changes.empty() || changes.back() != row)) changes.push_back(row);
    }
  }
  std::vector<RowRange> result;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (10 * changes[i] <= 9 * n) result.push_back({changes[i], i + 2 < changes.size() ? changes[i + 2] : n});
  }
  if (result.size() > kOrigins) result.erase(result.begin(), result.end() - kOrigins);
  if (result.size() == kOrigins) return result;
  return {{n * 55 / 100, n}, {n * 70 / 100, n}, {n * 85 / 100, n}};
}

}  // namespace

std::vector<ForecastFold> forecast_folds(const Design& design, const Series& first_run) {
  std::vector<ForecastFold> folds;
  if (design.runs == 1) {
    for (const RowRange& ahead : forecast_rows(design, first_run)) {
      folds.push_back({rows_between(0, ahead.begin), rows_between(ahead.begin, ahead.end), true});
    }
    return folds;
  }
  for (std::size_t run = 0; run < design.runs; ++run) {
    ForecastFold fold;
    for (std::size_t i = 0; i < design.run.size(); ++i) (design.run[i] == run ? fold.rows : fold.from).push_back(i);
    if (!fold.rows.empty() && !fold.from.empty()) folds.push_back(std::move(fold));
  }
  return folds;
}

std::vector<ForecastError> forecast(const Design& of_all, std::span<const Series> runs, const ForecastFold& fold,
                                    double named_variance, const ForecastOptions& options) {
  const bool is_named = options.named != nullptr && named_variance > 0.0;
  const Design anew =
      is_named ? with_named(of_all, fitted(*options.named, runs_until(of_all, runs, fold.from)), runs) : Design{};
  const Design& design = is_named ? anew : of_all;
  const RidgeProblem problem = ridge_problem(design, fold.from);
  return forecast(design, fold, problem,
                  options.few ? few_effects(problem) : ridge_fit(problem, chosen_setting(problem, named_variance)));
}

std::vector<ForecastError> forecast(const Design& design, const ForecastFold& fold, const RidgeProblem& problem,
                                    const RidgeFit& fit) {
  const bool goes_on = fold.goes_on;
  const double held = goes_on ? design.target_um[static_cast<Eigen::Index>(fold.from.back())] : 0.0;
  const double mean = goes_on ? design.target_um(fold.from).mean() : 0.0;
  const std::vector<std::size_t> predicted = thinned(fold.rows, kRidgeRows);
  const double weight = goes_on ? 1.0 : 1.0 / static_cast<double>(predicted.size());
  std::vector<ForecastError> errors;
  for (const std::size_t row : predicted) {
    const auto i = static_cast<Eigen::Index>(row);
    const double since_s = goes_on ? design.time_s[row] - problem.end_s : std::numeric_limits<double>::infinity();
    const Eigen::VectorXd x = design.values(std::vector{i}, Eigen::all).transpose();  // of no predictors, too
    const RidgePrediction at = ridge_prediction(problem, fit, x, since_s);
    const double um = design.target_um[i];
    errors.push_back({um - at.mean_um, um - held, um - mean, at.sigma_um, weight});
  }
  return errors;
}

std::vector<std::vector<ForecastError>> left_out_errors(const Design& design, const RidgeProblem& problem,
                                                        const RidgeSetting& setting) {
  const LeftOutRuns left = left_out_runs(problem, setting);
  Eigen::VectorXd value_um = problem.target_um;
  if (problem.start.size() > 0) value_um += problem.columns * problem.start;
  std::vector<double> rows(design.runs, 0.0);
  for (const std::size_t run : problem.run) rows[run] += 1.0;
  std::vector<std::vector<ForecastError>> errors(design.runs);
  for (Eigen::Index i = 0; i < left.error_um.size(); ++i) {
    const double value = value_um[i];
    const std::size_t run = problem.run[static_cast<std::size_t>(i)];
    errors[run].push_back({left.error_um[i], value, value, left.sigma_um[i], 1.0 / rows[run]});
  }
  return errors;
}

TestedForecasts tested(const std::vector<std::vector<ForecastError>>& of_folds) {
  std::vector<ForecastError> errors;
  std::size_t count = 0;
  for (const std::vector<ForecastError>& of_fold : of_folds) {
    count += of_fold.empty() ? 0 : 1;
    errors.insert(errors.end(), of_fold.begin(), of_fold.end());
  }
  TestedForecasts result;
  Forecasts& of = result.forecasts;
  of.count = count;
  of.rmse_um = rms_of(errors, &ForecastError::error_um);
  of.held_um = std::min(rms_of(errors, &ForecastError::held_um), rms_of(errors, &ForecastError::mean_um));
  of.error_um = mean_of(errors, [](const ForecastError& one) { return std::abs(one.error_um); });
  of.within_share = mean_of(errors, [](const ForecastError& one) { return sigmas(one) <= kNormal95 ? 1.0 : 0.0; });
  std::vector<double> all;
  for (const ForecastError& one : errors) all.push_back(sigmas(one));
  const auto n = static_cast<double>(all.size());
  const double at = order_statistic(std::move(all), static_cast<std::size_t>(0.95 * (n - 1.0)));
  result.interval_scale = std::max(1.0, at / kNormal95);
  return result;
}

HeldOutErrors left_out_of(const std::vector<std::vector<ForecastError>>& of_runs) {
  std::vector<double> rmse_um;
  std::vector<std::size_t> run;
  for (std::size_t r = 0; r < of_runs.size(); ++r) {
    if (of_runs[r].empty()) continue;
    rmse_um.push_back(rms_of(of_runs[r], &ForecastError::error_um));
    run.push_back(r);
  }
  HeldOutErrors result = held_out_errors(rmse_um);
  result.worst = run[result.worst];
  return result;
}

std::optional<TestedForecasts> tested_forecasts(const Design& design, std::span<const Series> runs,
                                                const RidgeProblem& problem, const RidgeSetting& setting,
                                                const ForecastOptions& options) {
  const auto say = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  if (!options.few && design.runs >= kFewestRunsToLeaveOut) {
    say(fmt::format("leaving out each of {} runs", design.runs));
    const std::vector<std::vector<ForecastError>> errors = left_out_errors(design, problem, setting);
    TestedForecasts result = tested(errors);
    result.left_out = left_out_of(errors);
    return result;
  }
  const std::vector<ForecastFold> folds = forecast_folds(design, runs.front());
  if (folds.empty()) return std::nullopt;
  std::vector<std::vector<ForecastError>> errors;
  for (std::size_t i = 0; i < folds.size(); ++i) {
    say(folds[i].goes_on ? fmt::format("forecast {} of {}", i + 1, folds.size())
                         : fmt::format("leaving out run {} of {}", i + 1, folds.size()));
    errors.push_back(forecast(design, runs, folds[i], setting.named_variance, options));
  }
  return tested(errors);
}

}  // namespace ballbar
