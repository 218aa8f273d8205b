// Several logs, each with its own clock, as one series.
#pragma once

#include <optional>
#include <vector>

#include "ballbar/formats/text/source.hpp"
#include "ballbar/series/series.hpp"
#include "logs/log_results.hpp"

namespace ballbar {

struct ClockOptions {
  bool keep_clocks = false;  // align by dates only
  std::optional<double> range_s, max_gap_s;
};

// The result has the clock of the first log. Throws Error for a log that cannot be read, or is given twice.
MergedSeries merged_series(const std::vector<Source>& logs, const ClockOptions& clocks);

void print_text(const MergedSeries& merged, const ClockOptions& clocks);

}  // namespace ballbar
