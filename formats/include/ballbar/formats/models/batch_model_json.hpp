// Model file of a regression on temperatures over batches, `.json`: what `predict` needs, and what it was trained on.
//
//   {"format": "ballbar-batch-model 1",
//    "target": "x_um", "room": "T_room_degC", "speed": "speed_rpm",      target in um; speed: null where none was
//    logged "sensors": ["T_front_degC", ...],                                   1 or more, each ends in _degC or _K
//    "inputs": "temperature" | "rise" | "both",                          m = sensors, for "both" twice as many
//    "method": "pcr" | "ridge", "components": 5,                         0 to m; pcr: 1 to m
//    "penalty_K2": 0.0,
//    "intercept_um": 1.5, "slope_um_per_K": [m numbers],
//    "trained_range": {"mean_degC": [m], "loadings": [p arrays of m], "variance_K2": [p], "score_low_K": [p],
//      "score_high_K": [p], "low_degC": [m], "high_degC": [m], "largest_T2": 9.0, "largest_Q_K2": 0.1},
//    "rmse_um": 1.0, "held_out_rmse_um": 1.5, "half_width_um": 3.0,
//    "batches": [{"name": "20200615", "rows": 515, "weight": 1.0, "rmse_um": 0.9, "held_out_um": 1.4}, ...]}
//
// All keys are there, in any order. held_out_um is null for a batch that was never left out (NaN in the struct).
#pragma once

#include <string>
#include <string_view>

#include "ballbar/predict/temperature_regression.hpp"

namespace ballbar {

// Numbers read back to the same doubles. Throws Error where one is not finite, which the reader would refuse.
std::string write_batch_model(const TemperatureRegression& model);

// `name` stands in messages. Throws Error "name: ..." with the path of the value, and line and column where the text is
// no JSON: an unknown, missing or double key, a value of another type, an array of another length than the sensors ask
// for, a negative variance, range low above high, a sensor twice, a name without its unit, no batch of weight above 0.
TemperatureRegression read_batch_model(std::string_view bytes, std::string_view name);

// Whether the head of a model's file is that of one of these, JSON, rather than of a model of effects, which is TOML.
bool is_batch_model_json(std::string_view head);

}  // namespace ballbar
