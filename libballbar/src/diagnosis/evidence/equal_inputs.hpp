// Inputs that measure the same quantity.
#pragma once

#include "ballbar/series/series.hpp"
#include "diagnosis/evidence/logged_inputs.hpp"

namespace ballbar {

// Finds the inputs that measure the same quantity (series/equal_columns); each of a group equals each other one. The
// mean of their curves, each with the weight of its noise, replaces them. data: as it was read.
void take_means(const Series& data, LoggedInputs& logged);

}  // namespace ballbar
