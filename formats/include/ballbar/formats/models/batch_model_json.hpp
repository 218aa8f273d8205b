// Model file `.json` of a regression on temperatures over batches: the data that `predict` needs, and a record of the
// training.
//
//   {"format": "ballbar-batch-model 1",
//    "target": "x_um", "room": "T_room_degC", "speed": "speed_rpm",      target in um; speed: null if none was logged
//    "sensors": ["T_front_degC", ...],                                   1 or more, each ends in _degC or _K
//    "inputs": "temperature" | "rise" | "both",                          m = sensors, for "both" twice as many
//    "method": "pcr" | "ridge", "components": 5,                         0 to m; pcr: 1 to m
//    "penalty_K2": 0.0,
//    "intercept_um": 1.5, "slope_um_per_K": [m numbers],
//    "trained_range": {"mean_degC": [m], "loadings": [p arrays of m], "variance_K2": [p], "score_low_K": [p],
//      "score_high_K": [p], "low_degC": [m], "high_degC": [m], "largest_T2": 9.0, "largest_Q_K2": 0.1},
//    "rmse_um": 1.0, "held_out_rmse_um": 1.5, "half_width_um": 3.0,
//    "batches": [{"name": "20200615", "rows": 515, "weight": 1.0, "rmse_um": 0.9, "held_out_um": 1.4}, ...]}
//
// All keys are required, in any order. held_out_um is null for a batch that was never left out (NaN in the struct).
#pragma once

#include <string>
#include <string_view>

#include "ballbar/predict/train.hpp"

namespace ballbar {

// Numbers are written so that they read back exactly. Throws Error for a number that is not finite.
std::string write_batch_model(const TemperatureRegression& model);

// `name` is used in messages. Throws Error "name: ..." with the path of the value, or line and column if the text is
// not JSON: an unknown, missing or duplicate key, a value of another type, an array whose length does not fit the
// sensors, a negative variance, low above high, a sensor twice, a name without unit, no batch of weight above 0.
TemperatureRegression read_batch_model(std::string_view bytes, std::string_view name);

// Whether the head of a model file is that of a batch model (JSON) rather than a model of effects (TOML).
bool is_batch_model_json(std::string_view head);

}  // namespace ballbar
