// Possible faults in the columns of a series, for a first check of the data. A diagnosis does not use them.
#pragma once

#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct ColumnFault {
  std::string column;  // empty: the time
  std::string what;    // "does not change: 21.5 in all rows"
};

// Finds columns that are constant, or constant in the last tenth of the rows after changes before; columns with more
// than 5 % gaps; single values that jump away and back by more than 20 times the usual change (the median change per
// row, or the resolution of the values); gaps in time of more than 10 usual steps. O(n) per column.
std::vector<ColumnFault> column_faults(const Series& series);

}  // namespace ballbar
