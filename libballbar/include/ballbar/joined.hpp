// A drift and the signals logged beside it, as one series.
#pragma once

#include <vector>

#include "ballbar/series.hpp"

namespace ballbar {

// Rows at all times of all parts within the time that every part of signals covers; parts on their own clocks, nothing
// decimated. Signals (every role but measured and event) are straight lines between their rows, across gaps of at most
// max_gap_s; measured columns stand where they were measured and are gaps elsewhere. Throws Error: a column that two
// parts have, a gap that is longer, parts with no time in common.
Series joined(const std::vector<Series>& parts, double max_gap_s);

}  // namespace ballbar
