// The state of a live prediction by a regression on effects, a JSON file, so that the next rows continue it.
//
//   {"format": "ballbar-prediction 1", "model": "digest of its file", "since_end": true, "live": {...}}
//
// ballbar writes it for itself.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/model/model.hpp"

namespace ballbar {

struct StoredPrediction {
  std::string model;       // digest of the model file
  bool since_end = false;  // it continues from the end of training
  LiveModel::State live;
};

std::string write_prediction_state(const StoredPrediction& stored);

// `name` is used in messages. Throws Error for anything that write_prediction_state() would not write.
// LivePrediction::resume() checks the numbers against the model.
StoredPrediction read_prediction_state(std::string_view bytes, std::string_view name);

}  // namespace ballbar
