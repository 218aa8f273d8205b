// Jumps of a thermometer's zero, as where it is calibrated, or another one takes its place.
#pragma once

#include <memory>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Data without such jumps are returned as they are. Takes the jumps of the thermometers on bodies (structure, housing,
// bearing) out of their columns and lists them in Series::sensor_jumps: a body cannot jump. Beside the median change of
// 4 rows on either side, such a jump from one row to the next is more than five times the largest change of the 8 rows
// on either side, and more than five usual changes. Its size is that of a jump in a parabola through these rows, and
// more than five times the rms of what it leaves. The rows about it are even, at most 2 min apart, and no other column
// changes as suddenly there: else something happened to the machine. A sensor that stands still on one side was stuck.
// A column with gaps, with values that its logger holds for some rows, or with more than two such jumps in a run is
// left as it is.
std::shared_ptr<const Series> without_sensor_jumps(const std::shared_ptr<const Series>& data);

}  // namespace ballbar
