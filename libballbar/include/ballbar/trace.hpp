// Ballbar recordings as one series, so that effects on a recording are fitted as effects on a drift are.
#pragma once

#include <span>
#include <string_view>

#include "ballbar/recording.hpp"
#include "ballbar/series.hpp"

namespace ballbar {

// Rows: all readings of all recordings, one recording after the other. Columns, which effects bind by themselves:
//   deviation_um      measured length less the nominal length
//   angle_rad         theta, from +A towards +B
//   direction         +1 CCW, -1 CW
//   feed_mm_per_min   NaN where it is not stated
//   radius_mm         nominal length
//   height_mm         h of recording.hpp
//   sweep_s           time since the middle of its recording's sweep; from the feed, or uniform, where there are no times
//   bar_degC          temperature of the bar, NaN where it is not stated
//   recording         0, 1, 2 ...
// time_s rises by the sweeps, put end to end 1 s apart. Throws Error for an axial recording.
Series trace_of(std::span<const Recording> recordings);

// The column of trace_of that an input's role stands for: "angle" -> "angle_rad"; empty for none.
std::string_view trace_column(std::string_view role);

}  // namespace ballbar
