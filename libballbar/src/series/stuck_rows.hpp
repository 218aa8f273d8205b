// Rows in which a sensor is stuck.
#pragma once

#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Up to three runs of equal values, 15 and 5 % of the rows at least, that the noise of the column does not have by
// chance: by the share of the windows of 10 rows elsewhere that are at rest, among those that do not mostly rise or
// fall. Behind such a run the column jumps to where it is, by three resolutions or more, or the column ends. is_body:
// it is the temperature of a body. Where that rises or falls in most windows, all of them count, and the jump is three
// times as large as any other. No value is NaN.
std::vector<RowRange> stuck_runs(const std::vector<double>& values, bool is_body = false);

}  // namespace ballbar
