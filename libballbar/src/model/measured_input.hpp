// Measured columns as inputs of effects: interpolation between tests.
//
// A drift is measured at tests 8 to 20 min apart, while effects are evaluated at the times of the signals, every few
// seconds. An effect on a drift series that reads a measured column (axial_crosstalk, bearing_clearance, an expression
// ...) interpolates it linearly between measured values, however far apart, and takes the nearest value before the
// first and after the last. Signals are not interpolated: merged() closes their gaps, or they are an error. Recordings
// have no gaps.
#pragma once

#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The n values of a column as an effect reads them: interpolated for a measured column that has a value, unchanged for
// any other column.
std::vector<double> input_values(const Series& data, const Column& column);

// The columns that the effects of the model read interpolated, each once, in the order of the effects.
std::vector<std::string> measured_inputs_with_gaps(const Model& model, const Series& data);

}  // namespace ballbar
