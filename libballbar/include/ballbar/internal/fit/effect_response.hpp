// The contribution of one effect over the rows of a data set, and its response to a step of one input.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The contribution of the effect alone in um, one value per row of the data. `parameters` has one entry per parameter
// of the effect, in its order. Throws Error as predict() does.
std::vector<double> effect_um(const Term& term, std::span<const FittedParameter> parameters, const Series& data);

// The response to a step of one input from its smallest to its largest value in the data, at 0 s. All other inputs
// stay at their median. The response lasts five times the effect's longest time constant, at least 30 min.
struct StepResponse {
  std::string input;                // the column
  double from = 0.0, to = 0.0;      // smallest and largest value, in the unit of the column
  std::vector<double> time_s;       // 240 values, from -10 % to 100 % of the duration
  std::vector<double> response_um;  // one value per time
};

// Returns nullopt where the input is constant, or another input has no value in the data.
std::optional<StepResponse> step_response(const Term& term, std::span<const FittedParameter> parameters,
                                          std::size_t input, const Series& data);

}  // namespace ballbar
