// The interval of the rows, if stated in the lines above the table.
#pragma once

#include <optional>

#include "logs/log_shape.hpp"

namespace ballbar {

// Seconds of "Sampling interval: 1s", "Abtastrate;100 Hz", "Delta_X 0.001" ...
std::optional<double> interval_of(const LogShape& shape);

}  // namespace ballbar
