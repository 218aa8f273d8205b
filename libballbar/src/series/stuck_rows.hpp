// Rows in which a sensor is stuck.
#pragma once

#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Up to three runs of equal values, 15 and 5 % of the rows at least, that the noise of the column does not have by
// chance: by the share of the windows of 10 rows elsewhere that are at rest, among those that do not mostly rise or
// fall; by the share of all windows where nearly all of them do, if the jump behind the run is three times as large as
// any other. Behind such a run the column jumps to where it is, by three resolutions or more, or the column ends. No
// value is NaN.
std::vector<RowRange> stuck_runs(const std::vector<double>& values);

}  // namespace ballbar
