// Jumps of a thermometer's zero, as where it is calibrated, or another one takes its place.
#pragma once

#include <cstddef>
#include <vector>

namespace ballbar {

struct OffsetJump {
  std::size_t row = 0;  // the first behind it
  double size = 0.0;
};

// The jumps from one row to the next of a column of a body that cannot jump. Beside the median change of 4 rows on
// either side, one is more than five times the largest change of the 8 rows on either side, and more than five
// resolutions. The size is that of a jump in a parabola through these rows, and more than five times the rms of what it
// leaves. A column with more than two has none.
std::vector<OffsetJump> offset_jumps(const std::vector<double>& values);

}  // namespace ballbar
