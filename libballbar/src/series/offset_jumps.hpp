// Jumps of a thermometer's zero, as where it is calibrated, or another one takes its place.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct OffsetJump {
  std::size_t row = 0;  // the first behind it
  double size = 0.0;
};

// The jumps from one row to the next of a thermometer on a body, which cannot jump. Beside the median change of 4 rows
// on either side, one is more than five times the largest change of the 8 rows on either side, and more than five usual
// changes. The size is that of a jump in a parabola through these rows, and more than five times the rms of what it
// leaves. The rows are evenly spaced, and no other column changes as suddenly there: else something happened to the
// machine. A column with more than two has none. It has no gaps, and time rises.
std::vector<OffsetJump> offset_jumps(const Series& data, const Column& column);

}  // namespace ballbar
