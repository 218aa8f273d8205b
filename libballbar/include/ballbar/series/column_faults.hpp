// Possible faults in the columns of a series, for a first check of the data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

enum class FaultKind : std::uint8_t {
  pauses,      // steps of time of more than 10 usual ones
  few_values,  // fewer than three
  gaps,        // in more than 5 % of the rows
  constant,    // in all rows
  stuck,       // constant in the last tenth of the rows, and more than 20 of them, after changes before
  far_off,     // up to three values in a row that are far off their neighbours: more than 10 sigma off the running
               // median of seven
  clipped,     // stands at its largest or smallest value, though it changes by more than its resolution just before
  jumps,  // of a measured column, three or more: in one step, by far more than it changes otherwise, while no input
          // jumps
};
std::string_view name_of(FaultKind kind);

struct ColumnFault {
  std::string column;  // empty: the time
  FaultKind kind = FaultKind::constant;
  std::size_t count = 0;  // pauses, rows or jumps
  double value = 0.0;     // constant, stuck, clipped: at which it stands; far_off: the first; jumps: their median size;
                          // pauses: the longest, in s; gaps: their share of the rows
  double at_s = 0.0;      // of the first of them; pauses: of the longest
  double long_s = 0.0;    // stuck, clipped: for how long in all; pauses: the shortest that counts
  bool is_low = false;    // clipped: at its smallest value
  bool is_beyond = false;  // far_off: beyond the range of all other values
};

// Columns of speed, load and events rest and jump by nature: of these only few values, gaps and constants are found.
// O(n) per column.
std::vector<ColumnFault> column_faults(const Series& series);

// Those that bear on what a model says of a target: of it, and of the columns of temperatures and other smooth inputs.
// Gaps and pauses change no verdict, a constant says that it does not change, and readings of an input far off their
// neighbours count only beyond its range.
std::vector<ColumnFault> faults_bearing_on(const Series& series, std::string_view target);

}  // namespace ballbar
