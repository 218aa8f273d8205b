// How far values go.
#pragma once

#include <span>

namespace ballbar {

// Largest less smallest value, 0 of none.
double range_of(std::span<const double> values);

}  // namespace ballbar
