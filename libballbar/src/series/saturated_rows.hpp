// Rows in which a sensor stands at the end of its range.
#pragma once

#include <cstddef>
#include <vector>

namespace ballbar {

struct SaturationLimits {
  std::size_t fewest_rows = 10;    // of a run of equal values
  double least_share = 0.05;       // of all rows
  double small_step = 1.5;         // resolutions: a sensor that comes to rest takes such steps before
  std::size_t fewest_changes = 8;  // to tell the resolution
};

// Rows, rising, in which a sensor stands at its largest or smallest value for long, though it changes by more than its
// resolution from row to row just before: a temperature that comes to rest does so by small steps. No value is NaN.
std::vector<std::size_t> saturated_rows(const std::vector<double>& values, const SaturationLimits& limits = {});

}  // namespace ballbar
