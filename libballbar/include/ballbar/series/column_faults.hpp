// What looks broken in the columns of a series: for a first look, not for a verdict.
#pragma once

#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct ColumnFault {
  std::string column;  // empty: the time
  std::string what;    // "does not change: 21.5 in all rows"
};

// A column that does not change, or not for the last tenth of the rows after it did; more than a twentieth gaps; single
// values that jump away and back by more than 20 times the usual change (its median from row to row, or the step to
// which values are written); rows apart more than 10 times the usual. O(n) a column.
std::vector<ColumnFault> column_faults(const Series& series);

}  // namespace ballbar
