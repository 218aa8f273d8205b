// Which tests of a machine can be held against each other.
//
// Those of one plane, nominal length, arc and feed, whatever the bar. Numbers differ where they leave a gap: lengths
// 0.1 mm, arcs and where they start 2 deg, feeds 5 %. Full circles compare wherever they start.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ballbar/history/machine_test.hpp"

namespace ballbar {

struct TestGroup {
  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  double start_deg = 0.0, arc_deg = 360.0;
  std::optional<double> feed_mm_per_min;  // of the last test; nothing: not stated
  std::vector<std::size_t> tests;         // places in the tests: by date, those without one first
};

// Of the tests at these places, by plane, length, arc, feed. O(n log n).
std::vector<TestGroup> groups_of(std::span<const MachineTest> tests, std::vector<std::size_t> places);

}  // namespace ballbar
