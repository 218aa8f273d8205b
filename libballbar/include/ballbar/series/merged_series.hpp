// Merges a drift and the signals logged during it into one series.
#pragma once

#include <memory>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// The result has a row at every time of every part, within the time that all signals cover. Each part keeps its own
// clock and nothing is decimated. Signals (every role but measured and event) are interpolated linearly across gaps of
// at most max_gap_s. Measured columns have values only where they were measured. An event keeps its last value; before
// the first it is a gap. The first [five_probe] table is kept. O(rows times columns).
//
// Throws Error: a column in two parts, a signal without any value, a signal with a gap longer than max_gap_s, parts
// without common time.
Series merged(const std::vector<Series>& parts, double max_gap_s);

// merged() of one series, keeping the start of its clock. Returns the series itself, not a copy, if it has no gap.
std::shared_ptr<const Series> with_gaps_closed(std::shared_ptr<const Series> series, double max_gap_s);

}  // namespace ballbar
