// Model file `.json` of a regression on effects, as `predict` and `compensate` need it.
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
// All keys are required, in any order. held_um is null if it is not known (NaN in the struct). `inputs` are in the
// order in which the terms first name the columns; `kept` is the memory of the effects.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/predict/train.hpp"

namespace ballbar {

inline constexpr std::string_view kRegressionFormat = "ballbar-effect-regression 1";

// Numbers are written so that they read back exactly, except factor_um, which is rounded to 9 digits (half widths are
// then accurate to 1e-6). Throws Error for a number that is not finite.
std::string write_effect_regression(const EffectRegression& regression);

// `name` is used in messages. Throws Error "name: ..." with the path of the value, or line and column if the text is
// not JSON: an unknown, missing or duplicate key, a value of another type, an effect that is not used in regressions
// (with the nearest name), a wrong number of columns or parameters of an effect, a shape outside its bounds, a column
// that `columns` lacks or no term reads, low above high, an array whose length does not fit the terms, a negative sigma
// or length, a scale below 1, an end state that does not fit the terms.
EffectRegression read_effect_regression(std::string_view bytes, std::string_view name,
                                        const Catalogue& catalogue = built_in_catalogue());

// Whether the head of a model file is that of a regression on effects. A batch model (batch_model_json.hpp) is JSON
// too.
bool is_effect_regression_json(std::string_view head);

}  // namespace ballbar
