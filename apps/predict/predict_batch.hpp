// `ballbar predict DATA --model model.json`: a regression over batches, on a file or on what comes by standard input.
#pragma once

#include <string>
#include <vector>

#include "ballbar/batches/batch_regression.hpp"
#include "ballbar/formats/text/source.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct BatchPredictOptions {
  Source data;  // "-": standard input
  Source model;
  std::vector<std::string> out;
  bool anyway = false;  // with sensors that look broken
  bool json = false;
};

// "z_um" -> "z"
std::string stem_of(const std::string& column);

// A file of a regression over batches rather than of a model of effects.
bool is_batch_model(const Source& model);

struct BatchJob {
  std::string source;
  BatchModel model;
  Series data;
  BatchPrediction prediction;
  std::vector<std::string> warnings;  // whole sentences
};

// `data` "-": standard input. Throws Error where a sensor looks broken, unless `anyway`.
BatchJob batch_job(const Source& data, const Source& model, bool anyway);

// Prints and writes as `predict`. Throws Error where a sensor looks broken.
void predict_batch(const BatchPredictOptions& options);

// A series from a file or, of "-", from the standard input.
Series read_data(const Source& data);

}  // namespace ballbar
