// Measured columns as inputs of effects: known at the tests, wanted at the times between.
//
// A drift is measured at its tests, 8 to 20 min apart; effects run on the signals' own times, every few seconds. An
// effect on a drift series that reads a measured column (axial_crosstalk, bearing_clearance, an expression ...) takes
// it as a straight line from one measured value to the next, however far apart, and as the nearest value before the
// first and after the last. At the tests themselves it is what was measured. Signals have no such lines: their gaps are
// closed by merged() or are an error. Nor have recordings, whose readings are whole.
#pragma once

#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// n values of a column for an effect: those of a measured column with the lines, where it has a value at all; those of
// any other as they are.
std::vector<double> input_values(const Series& data, const Column& column);

// The columns with lines that the model's effects read, each once, in the order of the effects.
std::vector<std::string> measured_inputs_with_gaps(const Model& model, const Series& data);

}  // namespace ballbar
