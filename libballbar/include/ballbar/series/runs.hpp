// Several runs of one machine as one series: stacked, the time of each from 0 again.
//
// Where `time_s` falls, another run begins. What has a memory (the filters of effects, noise) begins there anew, and a
// model has an offset for each run (run_terms.hpp), because a set-up is never made twice alike. What happens at a place
// of a temperature (a kink, a viscosity) is counted from the first row of the first run, as the machine is one.
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

// One range a run; none of no rows.
std::vector<RowRange> runs_of(std::span<const double> time_s);

// The rows of one run alone.
Series rows_of(const Series& data, const RowRange& range);

// Times that go on from run to run, each a day after the longest: for what only has to draw or to count.
std::vector<double> unrolled(std::span<const double> time_s);

// Times with one run right after another, for a picture or a file: a run begins a step of the clock after the last row.
std::vector<double> one_after_another(std::span<const double> time_s);

struct Stacked {
  Series series;
  std::vector<std::string> remarks;  // whole sentences: what was left out
};

// Runs one after another, in their order; of one run itself. Columns that not all have are left out; roles are those of
// the first. A run begins warm where it began less than 8 h after the end of another, or where its speed is not 0
// in the first row. zeros_s: the wall clock at time_s = 0 of each run (Series::started), s since any one day; empty:
// not known. Throws Error, with the names: runs of fewer than two rows, with no column in common, a column in other
// units (T_bed_degC, T_bed_K), the same rows twice, wall clocks that overlap.
Stacked stacked(const std::vector<Series>& runs, const std::vector<std::string>& names,
                const std::vector<std::optional<double>>& zeros_s = {});

}  // namespace ballbar
