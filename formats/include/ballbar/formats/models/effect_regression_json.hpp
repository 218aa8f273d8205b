// Model file of a regression on effects, `.json`: what `predict` and `compensate` need of it.
//
//   {"format": "ballbar-effect-regression 1",
//    "target": "z_um",
//    "dictionary": ["sources of heat", "temperatures"],   kinds of effects that take part, for people
//    "prior_variance": 0.1, "sigma_um": 1.2, "length_s": 7200.0, "interval_scale": 1.1,
//    "rows": 812, "runs": 1, "rmse_um": 0.9,              trained on
//    "forecasts": {"count": 3, "error_um": 0.8, "rmse_um": 1.1, "held_um": 2.0, "within_share": 0.95},    or null
//    "columns": [{"name": "T_oil_degC", "role": "structure", "low": 20.5, "high": 38.9}, ...],        each of a term
//    "left_out": ["T_hall_degC"],
//    "constant_um": -3.1,
//    "terms": [{"effect": "lagged_expansion", "columns": ["T_oil_degC"], "parameters": [2.2, 600.0],
//      "mean_um": 5.1, "sd_um": 2.0}, ...],               m, 1 or more; parameters as the effect's
//    "factor_um": [[0.1], [0.0, 0.2], ...],               m + 2 rows, the i-th of i numbers
//    "end": {"time_s": 28800.0, "step_s": 10.0, "discrepancy_um": -0.4,
//      "rows": 3, "times_s": [0.0, 28790.0, 28800.0], "inputs": [three a column], "kept": [...]}}
//
// All keys are there, in any order. held_um is null where it is not known (NaN in the struct). `inputs` are in the
// order in which the terms first name the columns, `kept` what the effects hand from row to row.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/predict/effect_regression.hpp"

namespace ballbar {

inline constexpr std::string_view kRegressionFormat = "ballbar-effect-regression 1";

// Numbers read back to the same doubles, but those of factor_um, which are rounded to 9 digits: half widths to 1e-6 of
// them. Throws Error where one is not finite, which the reader would refuse.
std::string write_effect_regression(const EffectRegression& regression);

// `name` stands in messages. Throws Error "name: ..." with the path of the value, and line and column where the text is
// no JSON: an unknown, missing or double key, a value of another type, an effect that takes no part in regressions
// (with the nearest), other columns or parameters than it has, a shape beyond its bounds, a column that `columns` lacks
// or no term reads, a range low above high, an array of another length than the terms ask for, a negative sigma or
// length, a scale below 1, a state at the end that is not of these terms.
EffectRegression read_effect_regression(std::string_view bytes, std::string_view name,
                                        const Catalogue& catalogue = built_in_catalogue());

// Whether the head of a model's file is that of one of these. A batch model (batch_model_json.hpp) is JSON too.
bool is_effect_regression_json(std::string_view head);

}  // namespace ballbar
