// How well rows are predicted that a training did not have.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/predict/train.hpp"
#include "predict/ridge.hpp"

namespace ballbar {

// Rows of the design that are predicted from others; goes_on: they come after them, else they are a run left out.
struct ForecastFold {
  std::vector<std::size_t> from, rows;
  bool goes_on = false;
};

// Of one run: from the last three changes of speed between half and nine tenths of the rows, each as far as the second
// change after it; without three such from 55, 70 and 85 % of the rows, to the end; none of fewer than 60 rows. Of
// several each run.
std::vector<ForecastFold> forecast_folds(const Design& design, const Series& first_run);

// Of a row that is predicted; held, mean: the error where the last value, or the mean, of the rows before is taken.
struct ForecastError {
  double error_um = 0.0, held_um = 0.0, mean_um = 0.0, sigma_um = 0.0, weight = 1.0;
};

struct ForecastOptions {
  bool few = false;              // of few_effects
  const Model* named = nullptr;  // whose terms the design has; fitted again to the rows that a forecast is from
  std::function<void(const std::string&)> progress = {};
};

// The setting is chosen from the fold's rows `from` alone, but for its named_variance, or is that of `fit`, which was
// fitted to them.
std::vector<ForecastError> forecast(const Design& design, std::span<const Series> runs, const ForecastFold& fold,
                                    double named_variance, const ForecastOptions& options);
std::vector<ForecastError> forecast(const Design& design, const ForecastFold& fold, const RidgeProblem& problem,
                                    const RidgeFit& fit);

// Of every run at once, by the setting given: a list for each run of the design.
std::vector<std::vector<ForecastError>> left_out_errors(const Design& design, const RidgeProblem& problem,
                                                        const RidgeSetting& setting);

struct TestedForecasts {
  Forecasts forecasts;
  double interval_scale = 1.0;
  std::optional<HeldOutErrors> left_out;  // the runs, of five or more
};

// Of the errors of each fold.
TestedForecasts tested(const std::vector<std::vector<ForecastError>>& of_folds);

// Of runs left out, a list of errors each.
HeldOutErrors left_out_of(const std::vector<std::vector<ForecastError>>& of_runs);

// Of one run forecasts from these origins; of several each run left out, of five or more with the setting given and
// the named terms as fitted to all. Nothing where there are too few rows.
std::optional<TestedForecasts> tested_forecasts(const Design& design, std::span<const Series> runs,
                                                const RidgeProblem& problem, const RidgeSetting& setting,
                                                const ForecastOptions& options);

}  // namespace ballbar
