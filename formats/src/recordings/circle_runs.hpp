// Splits the readings of a circle into runs of one direction.
#pragma once

#include <cstddef>
#include <vector>

namespace ballbar {

// The angles of `angle_rad`, each within half a turn of the one before.
std::vector<double> unwrapped(std::vector<double> angle_rad);

struct CircleRun {
  std::size_t first = 0, last = 0;  // readings, both of the run
  double travel_rad = 0.0;          // above 0: from the first axis towards the second
};

// A run ends where the angle comes back by more than 5 deg. Readings that stand still at its ends are left out, and
// runs of less than 30 deg beside longer ones.
std::vector<CircleRun> runs_of(const std::vector<double>& unwrapped_rad);

// The median size of the steps.
double middle_step_rad(const std::vector<double>& unwrapped_rad);

}  // namespace ballbar
