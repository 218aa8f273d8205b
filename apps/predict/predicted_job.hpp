// `ballbar predict DATA --model model.json`: a regression of `train`, on temperatures over batches or on effects, on a
// file or on what comes by standard input.
#pragma once

#include <string>
#include <vector>

#include "ballbar/formats/text/source.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "model/model_options.hpp"

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
BatchJob batch_job(const Source& data, const Source& model, const std::optional<double>& max_gap_s, bool anyway);

struct PredictOptions {
  ModelOptions model;      // of a regression the first of its data is the job: file, session of effects, or - for stdin
  std::vector<Source> on;  // by a physical model: other data
  std::vector<std::string> out;
  std::string state;    // by effects: where a live prediction stands; empty: none
  bool anyway = false;  // by temperatures: with sensors that look broken
  bool json = false;
};

// Print and write as `predict`. Throw Error as batch_job.
void predict_by_temperatures(const PredictOptions& options);
void predict_by_effects(const PredictOptions& options);

}  // namespace ballbar
