// A drift and the signals logged beside it, as one series.
#pragma once

#include <memory>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Rows at all times of all parts within the time that every signal covers; parts on their own clocks, nothing
// decimated. Signals (every role but measured and event) are straight lines between their values, across gaps of at
// most max_gap_s. Measured columns stand where they were measured and are gaps elsewhere. An event keeps its last
// value; before the first it is a gap. The first [five_probe] table is kept. O(rows times columns).
//
// Throws Error: a column that two parts have, a signal without any value, a gap between two values that is longer,
// parts with no time in common.
Series merged(const std::vector<Series>& parts, double max_gap_s);

// `merged` of one series, whose clock keeps its start. Where it has no gap to close, it is the series itself, not a
// copy.
std::shared_ptr<const Series> with_gaps_closed(std::shared_ptr<const Series> series, double max_gap_s);

}  // namespace ballbar
