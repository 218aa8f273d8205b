// Several logs, each with its own clock, as one series.
#pragma once

#include <optional>
#include <vector>

#include "ballbar/formats/text/source.hpp"
#include "ballbar/series/series.hpp"
#include "logs/log_results.hpp"

namespace ballbar {

struct ClockOptions {
  bool keep_clocks = false;  // by their dates alone
  std::optional<double> range_s, max_gap_s;
};

// The clock of the first log counts. Throws Error: a log that cannot be read, or that comes twice.
MergedSeries merged_series(const std::vector<Source>& logs, const ClockOptions& clocks);

void print_text(const MergedSeries& merged, const ClockOptions& clocks);

}  // namespace ballbar
