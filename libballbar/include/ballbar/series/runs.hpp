// Several runs of one machine as one series, stacked. The time of each run starts again.
//
// A new run begins where `time_s` falls. The memory of effects and noise restarts there, and a model has an offset for
// each run (run_terms.hpp), because no set-up repeats exactly. Thresholds in temperature (a kink, a viscosity) refer to
// the first row of the first run, because all runs are of one machine.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct RowRange {
  std::size_t begin = 0, end = 0;  // rows [begin, end)
};

// One range per run; empty without rows.
std::vector<RowRange> runs_of(std::span<const double> time_s);

// The series of one run.
Series rows_of(const Series& data, const RowRange& range);

// Rising times with the runs end to end, for a picture or a file. A run begins one clock step after the last row.
std::vector<double> one_after_another(std::span<const double> time_s);

struct Stacked {
  Series series;
  std::vector<std::string> remarks;  // whole sentences: which columns were left out
};

// Stacks the runs in their order; a single run is returned unchanged. Columns that some runs lack are left out. Roles
// are those of the first run. A run begins warm if it began less than 8 h after the end of another, or if its speed is
// not 0 in the first row. zeros_s: the wall clock at time_s = 0 of each run (Series::started), in s since a common day;
// empty: not known. Throws Error, with the names of the runs: fewer than two rows, no common column, a column in
// different units (T_bed_degC, T_bed_K), the same rows twice, wall clocks that overlap.
Stacked stacked(const std::vector<Series>& runs, const std::vector<std::string>& names,
                const std::vector<std::optional<double>>& zeros_s = {});

}  // namespace ballbar
