// Where a live prediction by a regression on effects stands, so that the next rows go on from there: a JSON file.
//
//   {"format": "ballbar-prediction 1", "model": "digest of its file", "since_end": true, "live": {...}}
//
// It is written by ballbar for ballbar.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/model/live_model.hpp"

namespace ballbar {

struct StoredPrediction {
  std::string model;       // what tells it from others
  bool since_end = false;  // it went on from the end of training
  LiveModel::State live;
};

std::string write_prediction_state(const StoredPrediction& stored);

// `name` stands in messages. Throws Error for anything but what write_prediction_state wrote; whether the numbers suit
// the model is for LivePrediction::resume.
StoredPrediction read_prediction_state(std::string_view bytes, std::string_view name);

}  // namespace ballbar
