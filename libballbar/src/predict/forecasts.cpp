#include "predict/forecasts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "ballbar/numerics/order_statistic.hpp"
#include "ballbar/series/runs.hpp"
#include "ballbar/series/speed_steps.hpp"
#include "predict/selection.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestRows = 60, kOrigins = 3;

constexpr double kLeastSigma_um = 1e-6;  // of a target that stands still

// Of a row that is predicted; held, mean: what is left where the last value, or the mean, of the rows before is taken.
struct ForecastError {
  double error_um = 0.0, held_um = 0.0, mean_um = 0.0, sigma_um = 0.0, weight = 1.0;

  double sigmas() const { return std::abs(error_um) / std::max(sigma_um, kLeastSigma_um); }
};

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

TestedForecasts tested(std::size_t count, const std::vector<ForecastError>& errors) {
  TestedForecasts result;
  Forecasts& of = result.forecasts;
  of.count = count;
  of.rmse_um = rms_of(errors, &ForecastError::error_um);
  of.held_um = std::min(rms_of(errors, &ForecastError::held_um), rms_of(errors, &ForecastError::mean_um));
  of.error_um = mean_of(errors, [](const ForecastError& one) { return std::abs(one.error_um); });
  of.within_share = mean_of(errors, [](const ForecastError& one) { return one.sigmas() <= kNormal95 ? 1.0 : 0.0; });
  std::vector<double> sigmas;
  for (const ForecastError& one : errors) sigmas.push_back(one.sigmas());
  const auto n = static_cast<double>(sigmas.size());
  const double at = order_statistic(std::move(sigmas), static_cast<std::size_t>(0.95 * (n - 1.0)));
  result.interval_scale = std::max(1.0, at / kNormal95);
  return result;
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

// Predicts these rows from those, the setting chosen from those alone.
void forecast(const Design& of_all, std::span<const Series> runs, const std::vector<std::size_t>& from,
              const std::vector<std::size_t>& rows, bool goes_on, double named_variance, const ForecastOptions& options,
              std::vector<ForecastError>& errors) {
  const bool is_named = options.named != nullptr && named_variance > 0.0;
  const Design anew = is_named ? with_named(of_all, *options.named, runs_until(of_all, runs, from), runs) : Design{};
  const Design& design = is_named ? anew : of_all;
  const RidgeProblem problem = ridge_problem(design, from);
  const RidgeFit fit = options.few ? few_effects(problem) : ridge_fit(problem, chosen_setting(problem, named_variance));
  const double held = goes_on ? design.target_um[static_cast<Eigen::Index>(from.back())] : 0.0;
  const double mean = goes_on ? design.target_um(from).mean() : 0.0;
  const std::vector<std::size_t> predicted = thinned(rows, kRidgeRows);
  const double weight = goes_on ? 1.0 : 1.0 / static_cast<double>(predicted.size());
  for (const std::size_t row : predicted) {
    const auto i = static_cast<Eigen::Index>(row);
    const double since_s = goes_on ? design.time_s[row] - problem.end_s : std::numeric_limits<double>::infinity();
    const RidgePrediction at = ridge_prediction(problem, fit, design.values.row(i).transpose(), since_s);
    const double um = design.target_um[i];
    errors.push_back({um - at.mean_um, um - held, um - mean, at.sigma_um, weight});
  }
}

std::vector<std::size_t> rows_between(std::size_t first, std::size_t end) {
  std::vector<std::size_t> rows(end - first);
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}

// Of every run at once, by the setting given.
TestedForecasts of_left_out_runs(const Design& design, const RidgeProblem& problem, const RidgeSetting& setting) {
  const LeftOutRuns left = left_out_runs(problem, setting);
  std::vector<double> rows(design.runs, 0.0);
  for (const std::size_t run : problem.run) rows[run] += 1.0;
  std::vector<ForecastError> errors;
  for (Eigen::Index i = 0; i < left.error_um.size(); ++i) {
    const double value = problem.target_um[i];
    errors.push_back(
        {left.error_um[i], value, value, left.sigma_um[i], 1.0 / rows[problem.run[static_cast<std::size_t>(i)]]});
  }
  TestedForecasts result = tested(left.run.size(), errors);
  result.left_out = held_out_errors(left.rmse_um);
  result.left_out->worst = left.run[result.left_out->worst];
  return result;
}

}  // namespace

std::vector<ForecastRows> forecast_rows(const Design& design, const Series& run) {
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
  std::vector<ForecastRows> result;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (10 * changes[i] <= 9 * n) result.push_back({changes[i], i + 2 < changes.size() ? changes[i + 2] : n});
  }
  if (result.size() > kOrigins) result.erase(result.begin(), result.end() - kOrigins);
  if (result.size() == kOrigins) return result;
  return {{n * 55 / 100, n}, {n * 70 / 100, n}, {n * 85 / 100, n}};
}

std::optional<TestedForecasts> tested_forecasts(const Design& design, std::span<const Series> runs,
                                                const RidgeProblem& problem, const RidgeSetting& setting,
                                                const ForecastOptions& options) {
  const auto say = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  std::vector<ForecastError> errors;
  if (design.runs == 1) {
    const std::vector<ForecastRows> ahead = forecast_rows(design, runs.front());
    if (ahead.empty()) return std::nullopt;
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      say(fmt::format("forecast {} of {}", i + 1, ahead.size()));
      forecast(design, runs, rows_between(0, ahead[i].first), rows_between(ahead[i].first, ahead[i].end), true,
               setting.named_variance, options, errors);
    }
    return tested(ahead.size(), errors);
  }
  if (!options.few && design.runs >= kFewestRunsToLeaveOut) {
    say(fmt::format("leaving out each of {} runs", design.runs));
    return of_left_out_runs(design, problem, setting);
  }
  for (std::size_t run = 0; run < design.runs; ++run) {
    say(fmt::format("leaving out run {} of {}", run + 1, design.runs));
    std::vector<std::size_t> from, rows;
    for (std::size_t i = 0; i < design.run.size(); ++i) (design.run[i] == run ? rows : from).push_back(i);
    if (!rows.empty() && !from.empty())
      forecast(design, runs, from, rows, false, setting.named_variance, options, errors);
  }
  return tested(design.runs, errors);
}

}  // namespace ballbar
