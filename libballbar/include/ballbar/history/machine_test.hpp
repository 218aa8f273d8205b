// One ballbar test as the history of a machine keeps it: numbers and what they were measured with, no readings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"

namespace ballbar {

struct TestQuantity {
  std::string name;  // a row of MachineErrors, or "circularity", "residual_rms", "scale_x", "scale_y", "scale_z"
  std::string unit;
  double value = 0.0;
  double sigma = std::numeric_limits<double>::quiet_NaN();  // NaN: not known, as of a value that a file stores
  bool of_set_up = false;                // where the bar was put: it says nothing of the machine, and has no history
  bool significant = true;               // false: of an error that the test does not show
  std::optional<std::size_t> rank = {};  // of its error by what mending it gains, 1 the most; nothing: it has none
};

// In the quantity's unit; either end may be open.
struct Tolerance {
  std::string quantity;
  std::optional<double> lower, upper;
};

bool within(const Tolerance& tolerance, double value);

struct MachineTest {
  std::string file;
  std::string second_file;                // of the other direction, where it lies in a log of its own; else empty
  std::string machine;                    // as the file names it; empty: not stated
  std::string bar;                        // its serial number; empty: not stated
  std::optional<std::int64_t> started_s;  // on the machine's clock, s since 1970-01-01T00:00:00
  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  std::optional<double> feed_mm_per_min;
  double start_deg = 0.0;  // of the readings, counter-clockwise, [0, 360)
  double arc_deg = 360.0;
  std::vector<Direction> directions;  // of its recordings, each once; empty: not stated
  bool stored = false;                // values that the file stores, which has no readings
  std::vector<TestQuantity> quantities;
  std::vector<Tolerance> tolerances;       // that the file states
  std::optional<AxisScales> scales;        // of axes_of(plane)
  std::optional<MachineError> squareness;  // of the plane; sigma NaN: not known
};

// What the test of these recordings was made with, without what was found in them.
MachineTest test_head(std::span<const Recording> recordings);

// The test of these recordings and of what machine_errors found in them; file, machine and bar are left open. The feed
// is the mean of the recordings', the date the earliest. Sigma of circularity: of a difference of two readings by the
// noise of the fit; of residual_rms: of so many independent readings as noise with that memory is worth.
MachineTest machine_test(const MachineErrors& errors, std::span<const Recording> recordings);

// "scale_x", "scale_y", "scale_z" of 0, 1, 2.
std::string scale_name(int axis);

// Which tests of a machine can be held against each other.
//
// Those of one plane, nominal length, arc and feed, whatever the bar. Numbers differ where they leave a gap: lengths
// 0.1 mm, arcs and where they start 2 deg, feeds 5 %. Full circles compare wherever they start.

struct TestGroup {
  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  double start_deg = 0.0, arc_deg = 360.0;
  std::optional<double> feed_mm_per_min;  // of the last test; nothing: not stated
  std::vector<std::size_t> tests;         // places in the tests: by date, those without one first
};

// What two tests of one plane were made with that is not the same. With another length, arc or feed they are of two
// groups. What one of them does not state is no difference.
enum class TestCondition {
  nominal_length,
  arc,
  feed,
  directions,
  bar,
  machine,
  stored,  // one has readings, the other the results of the instrument's software alone
};
std::string_view name_of(TestCondition condition);

std::vector<TestCondition> differing_conditions(const MachineTest& one, const MachineTest& other);

// Of the tests at these places, by plane, length, arc, feed. O(n log n).
std::vector<TestGroup> groups_of(std::span<const MachineTest> tests, std::vector<std::size_t> places);

}  // namespace ballbar
