// What one effect draws: over the rows of data, and for a step of one of its inputs.
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

// The effect alone at these parameters, um, one value a row of the data; one parameter for each of the effect's.
// Throws Error as predict().
std::vector<double> effect_um(const Term& term, std::span<const FittedParameter> parameters, const Series& data);

// An input at its least value of the data for a tenth of the time and at its largest from 0 s on; the other inputs stay
// at their median. The time: five of the effect's longest time constant, at least 30 min.
struct StepResponse {
  std::string input;                // the column
  double from = 0.0, to = 0.0;      // in its unit
  std::vector<double> time_s;       // 240 rows, from -10 % of the time to it
  std::vector<double> response_um;  // of the same rows
};

// Nothing where the input stands still, or another has no value in the data.
std::optional<StepResponse> step_response(const Term& term, std::span<const FittedParameter> parameters,
                                          std::size_t input, const Series& data);

}  // namespace ballbar
