// How well rows are predicted that a training did not have.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/predict/effect_regression.hpp"
#include "predict/ridge.hpp"

namespace ballbar {

// Where a forecast begins and how far it goes: rows [first, end) of the design are predicted from those before.
struct ForecastRows {
  std::size_t first = 0, end = 0;
};

// Of one run: the last three changes of speed between half and nine tenths of the rows, each as far as the second
// change after it; without three such at 55, 70 and 85 % of the rows, to the end. None of fewer than 60 rows.
std::vector<ForecastRows> forecast_rows(const Design& design, const Series& run);

struct TestedForecasts {
  Forecasts forecasts;
  double interval_scale = 1.0;
  std::optional<HeldOutErrors> left_out;  // the runs, of five or more
};

struct ForecastOptions {
  bool few = false;              // of few_effects
  const Model* named = nullptr;  // whose terms the design has; fitted again to the rows that a forecast is from
  std::function<void(const std::string&)> progress = {};
};

// Of one run forecasts from these origins; of several each run left out, of five or more with the setting given and
// the named terms as fitted to all. Nothing where there are too few rows.
std::optional<TestedForecasts> tested_forecasts(const Design& design, std::span<const Series> runs,
                                                const RidgeProblem& problem, const RidgeSetting& setting,
                                                const ForecastOptions& options);

}  // namespace ballbar
