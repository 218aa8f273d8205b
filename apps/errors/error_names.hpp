// Readable names of the errors of a machine: the axes a and b of the catalogue become X and Y in the plane XY, and
// reversal_spike_a becomes "reversal spike of X".
#pragma once

#include <string>
#include <string_view>

#include "ballbar/circle/recording.hpp"
#include "ballbar/machine_errors/next_measurement.hpp"

namespace ballbar {

std::string plain_name(std::string_view effect, Plane plane);

// "Axis A moves sideways, along B": the catalogue's summaries, where a word that is A or B is an axis.
std::string with_axes(std::string_view summary, Plane plane);

// "Measure the other direction."
std::string measurement_text(const NextMeasurement& next);

}  // namespace ballbar
