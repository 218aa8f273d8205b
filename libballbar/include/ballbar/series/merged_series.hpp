// Merges a drift and the signals logged during it into one series.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// The result has a row at every time of every part, within the time that all signals cover. Each part keeps its own
// clock and nothing is decimated. Measured columns have values only where they were measured. Signals (every role but
// measured and event) are interpolated linearly across gaps of at most max_gap_s; nullopt: 3 median steps of the
// signal's own values, and at least 10 min. A row within a longer gap is left out. A gap without a row in it costs
// nothing: rows read by hand may stop for the night. An event keeps its last value, and is interpolated as a signal
// where its values are smooth (signal_kind) and not whole numbers; before the first value it is a gap. The first
// [five_probe] table is kept. O(rows times columns).
//
// Throws Error: a column in two parts, a signal without any value, parts without common time, less than two thirds of
// the rows, or of the values of a measured column, outside the gaps of signals.
Series merged(const std::vector<Series>& parts, std::optional<double> max_gap_s);

// Rows that merged() leaves out for want of a signal. A row may lack several.
struct RowsWithout {
  std::string signal;
  std::size_t rows = 0;
  double max_gap_s = 0.0;  // longest gap over which this signal is interpolated
};
std::vector<RowsWithout> rows_without_signal(std::span<const Series> parts, std::optional<double> max_gap_s);

// A stretch with rows, between two values of a signal.
struct SignalGap {
  std::string signal;
  double from_s = 0.0, to_s = 0.0;
};
// Where merged() throws for the rows within gaps: the longest gap, with which as max_gap_s it keeps all rows. nullopt:
// it does not throw for them.
std::optional<SignalGap> longest_gap(std::span<const Series> parts, std::optional<double> max_gap_s);

// merged() of one series, keeping the start of its clock. Returns the series itself, not a copy, if it has no gap.
std::shared_ptr<const Series> with_gaps_closed(std::shared_ptr<const Series> series, std::optional<double> max_gap_s);

}  // namespace ballbar
