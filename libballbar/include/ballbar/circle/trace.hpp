// Converts ballbar recordings into one series, so that effects on recordings are fitted like effects on a drift.
#pragma once

#include <span>
#include <string_view>

#include "ballbar/circle/recording.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Rows: all readings of all recordings, one recording after the other, in the order of their readings. Columns, which
// effects bind by themselves:
//   deviation_um      measured length less the nominal length
//   angle_rad         theta, from +A towards +B
//   direction         +1 CCW, -1 CW
//   feed_mm_per_min   NaN where it is not stated
//   radius_mm         nominal length
//   height_mm         h of recording.hpp
//   sweep_s           time since the middle of its recording's sweep, half way from the first reading to the last
//   bar_degC          temperature of the bar, NaN where it is not stated
//   recording         0, 1, 2 ...
//   linear_axes       1 where two linear axes drive the circle, else 0
//   pitch_a_mm, _b    of the screws, NaN where they are not stated
// If a recording has no times, its n readings are at mid-sample of a sweep whose duration is nominal length times arc
// over feed; without a feed there is one reading per second. time_s starts at 0, with the sweeps end to end, 1 s apart.
// Throws Error for an axial recording, and for times that do not rise. O(n), 104 bytes per reading.
Series trace_of(std::span<const Recording> recordings);

// The column of trace_of() for the role of an input: "angle" -> "angle_rad"; empty: none.
std::string_view trace_column(std::string_view role);

}  // namespace ballbar
