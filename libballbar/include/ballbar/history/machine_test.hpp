// One ballbar test in the history of a machine: its results and conditions, without readings.
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
  std::string
      name;  // a row or a group of MachineErrors, or "circularity", "residual_rms", "scale_x", "scale_y", "scale_z"
  std::string unit;
  double value = 0.0;
  double sigma = std::numeric_limits<double>::quiet_NaN();  // NaN: not known, as for stored values
  bool of_set_up = false;                // describes the position of the bar, not the machine; has no history
  bool significant = true;               // false: of an error that is not significant
  std::optional<std::size_t> rank = {};  // of its error, 1: largest gain from correction; nullopt: no rank
};

// Tolerance limits in the unit of the quantity; either end may be open.
struct Tolerance {
  std::string quantity;
  std::optional<double> lower, upper;
};

bool within(const Tolerance& tolerance, double value);

struct MachineTest {
  std::string file;
  std::string second_file;                // the file of the other direction; empty: same file
  std::string machine;                    // as the file names it; empty: not stated
  std::string bar;                        // its serial number; empty: not stated
  std::optional<std::int64_t> started_s;  // on the machine's clock, s since 1970-01-01T00:00:00
  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  std::optional<double> feed_mm_per_min;
  double start_deg = 0.0;  // of the readings, counter-clockwise, [0, 360)
  double arc_deg = 360.0;
  std::vector<Direction> directions;  // directions of its recordings, each once; empty: not stated
  bool stored = false;                // the file has stored values and no readings
  std::vector<TestQuantity> quantities;
  std::vector<Tolerance> tolerances;       // stated in the file
  std::vector<std::string> beyond_limits;  // names of stored results that fail a limit in the file
  std::optional<bool> passes;              // the tolerance of the circularity and these limits; nullopt: not asked
  std::optional<AxisScales> scales;        // of axes_of(plane)
  std::optional<MachineError> squareness;  // of the plane; sigma NaN: not known
};

// The conditions of the test of these recordings, without results.
MachineTest test_head(std::span<const Recording> recordings);

// The test of these recordings with the results of machine_errors(); file, machine and bar stay empty. The feed is the
// mean of the recordings, the date the earliest. Sigma of the circularity: that of a difference of two readings with
// the noise of the fit. Sigma of residual_rms: from the effective number of independent readings.
MachineTest machine_test(const MachineErrors& errors, std::span<const Recording> recordings);

// "scale_x", "scale_y", "scale_z" for axis 0, 1, 2.
std::string scale_name(int axis);

// A group of comparable tests of a machine.
//
// Tests are comparable if plane, nominal length, arc and feed agree, with any bar. Sorted values are split into groups
// at gaps of more than 0.1 mm in length, 2 deg in arc and start, 5 % in feed. Full circles compare whatever their
// start.

struct TestGroup {
  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  double start_deg = 0.0, arc_deg = 360.0;
  std::optional<double> feed_mm_per_min;  // of the last test; nullopt: not stated
  std::vector<std::size_t> tests;         // indices of the tests, by date, undated ones first
};

// A condition in which two tests of one plane differ. Tests that differ in length, arc or feed belong to different
// groups. A condition that one test does not state is no difference.
enum class TestCondition {
  nominal_length,
  arc,
  feed,
  directions,
  bar,
  machine,
  stored,  // one has readings, the other only results of the instrument's software
};
std::string_view name_of(TestCondition condition);

std::vector<TestCondition> differing_conditions(const MachineTest& one, const MachineTest& other);

// Groups the tests at these indices by plane, length, arc and feed. O(n log n).
std::vector<TestGroup> groups_of(std::span<const MachineTest> tests, std::vector<std::size_t> places);

}  // namespace ballbar
