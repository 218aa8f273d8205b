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

// A new step begins where the speed leaves the step's first value by more than 2 % of the largest speed; a step shorter
// than 60 s (a ramp) joins the one after it. Where the speed of the step before comes back within
// 60 s (a stray row), to 2 % of the largest speed as well, that step goes on. A row without speed continues its step.
// The steps cover all rows; a run begins one. O(n).
std::vector<SpeedStep> speed_steps(const std::vector<double>& time_s, const Column& speed);

}  // namespace ballbar
