// The stretches of constant speed of a recording.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct SpeedStep {
  double speed_rpm = 0.0;  // median of the stretch
  std::size_t begin = 0;   // rows [begin, end)
  std::size_t end = 0;
};

// A new step begins where the speed differs from the step's first value by more than 2 % of the largest speed. A step
// shorter than 60 s (a ramp) joins the next one. If the earlier speed returns within 60 s (a stray row), to 2 % of the
// largest speed, the earlier step continues. A row without speed continues its step. The steps cover all rows; a run
// begins a new step. O(n).
std::vector<SpeedStep> speed_steps(const std::vector<double>& time_s, const Column& speed);

}  // namespace ballbar
