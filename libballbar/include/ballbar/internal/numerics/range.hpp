// The range of values.
#pragma once

#include <span>

namespace ballbar {

// Largest minus smallest value; 0 without values.
double range_of(std::span<const double> values);

}  // namespace ballbar
