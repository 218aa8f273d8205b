// `ballbar predict DATA --model model.json`: a regression of `train`, on temperatures over batches or on effects, on a
// file or on what comes by standard input.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/text/source.hpp"
#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/predict/temperature_regression.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// "z_um" -> "z"
std::string stem_of(const std::string& column);

struct PredictedJob {
  std::string source, target;
  Series data;
  RegressionPrediction prediction;
  std::vector<std::string> warnings;  // whole sentences
};

struct BatchJob {
  TemperatureRegression model;
  PredictedJob job;
};

// `data` "-": standard input. Throws Error where a sensor looks broken, unless `anyway`.
BatchJob batch_job(const Source& data, const Source& model, bool anyway);

struct JobOptions {
  Source data;  // file, session of effects, or - for the standard input
  Source model;
  std::vector<std::string> out;
  bool json = false;
  bool anyway = false;                   // by temperatures: with sensors that look broken
  std::string state = {};                // by effects: where a live prediction stands; empty: none
  std::optional<double> max_gap_s = {};  // by effects
};

// Print and write as `predict`. Throw Error as batch_job.
void predict_by_temperatures(const JobOptions& options);
void predict_by_effects(const JobOptions& options);

}  // namespace ballbar
