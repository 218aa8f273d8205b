// `--set EFFECT.PARAMETER=VALUE`: the model with a parameter held at another value.
#pragma once

#include <string>
#include <vector>

#include "ballbar/model/model.hpp"

namespace ballbar {

// settings: "lagged_expansion(T9_degC).time_constant_s=3600", "constant.constant_um=0"; the effect as `check` prints
// it. Throws Error for text of another form, and for an effect or a parameter that the model has not, with the nearest.
Model with_held_values(Model model, const std::vector<std::string>& settings);

// Likewise with parameters that are free, from the values on. Throws Error for the constant too, which has no start.
Model with_free_values(Model model, const std::vector<std::string>& settings);

}  // namespace ballbar
