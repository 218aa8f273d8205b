// Which thermal test a record is, what it lacks, and the numbers of its sheet.
//
// The scope of ISO 230-3:2020 names four tests: environmental temperature variation error (ETVE), thermal distortion
// by a rotating spindle, by moving linear axes, and by rotary motion of components. The speed of the spindle, or the
// feed of an axis (mm/min, deg/min), shows which of them a record is:
//
//   the spindle rests and no axis moves                                 environment
//   the spindle turns, at one speed for 95 % of the time that it turns  spindle
//   the spindle turns at several speeds                                 spindle_spectrum
//   an axis moves and the spindle rests or has no column                linear_axes, rotary_axes
//   none of these columns                                               unknown
//
// Where the column of a speed has the letter of a rotary axis as a word (A, B, C: "n_C_axis"), it is that of the axis.
//
// At rest is at most 1 rpm, mm/min or deg/min, or faster for at most a minute (a tenth of a short record) in all. Only
// values from `from_s` to `to_s` count. Two speeds are one if they differ by at most 2 % of the largest speed
// (speed_steps.hpp), ramps included.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/measured_drift.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class ThermalTestKind { unknown, environment, spindle, spindle_spectrum, linear_axes, rotary_axes };

std::string_view name_of(ThermalTestKind kind);  // "spindle_spectrum"

// What a reader of the sheet would miss.
enum class TestLack {
  speed,                  // which test it is
  room_temperature,       // the cause of ETVE, and a part of every other drift
  structure_temperature,  // of the spindle or the machine: what a compensation needs
  a_day,                  // ETVE: 24 h, in which a room goes through its cycle
  rest_after              // spindle: at least 10 min at rest after it has turned, which show the cooling
};

std::string_view name_of(TestLack lack);

struct TemperatureSpan {
  std::string column;
  Role role = Role::structure;
  double first_degC = 0.0, least_degC = 0.0, largest_degC = 0.0;
};

struct ThermalTest {
  ThermalTestKind kind = ThermalTestKind::unknown;
  std::string motion;       // the column of the speed or feed that shows it; empty: unknown
  std::string motion_unit;  // "rpm", "mm_per_min", "deg_per_min"
  double from_s = 0.0;
  double duration_s = 0.0;
  double running_s = 0.0;      // the spindle turns, or the axis moves
  double rest_after_s = 0.0;   // from its last stop to the end
  std::vector<double> speeds;  // in that unit, each for at least 5 % of running_s, rising; at most 20; else the longest
  std::vector<TemperatureSpan> temperatures;  // those of the room first
  std::vector<TestLack> lacks;
};

// Of what was logged from `from_s` to `to_s`. O(rows).
ThermalTest thermal_test(std::span<const Series> signals, double from_s, double to_s);

// The column of the speed or feed that moves, as above; nullptr: none.
const Column* motion_of(const Series& series);

// The largest drift from the reference, and when.
struct LargestDrift {
  std::string axis;  // "combined": root of the sum of squares of x, y and z; "combined x, y" of two of them
  std::string unit;
  Estimate drift;
  double time_s = 0.0;
};

// One for each axis that has a value; "combined" last, of the rows in which x, y and z have one, or those two of them
// that there are. From 30 rows on it is that of the smoothing spline of range_of(), less its value at the reference:
// the largest of noisy rows is too large. Of fewer rows it is that of the rows themselves. An axis is x if its name is
// x, or if it alone has a word x or dx in its name ("Probe_X", "dX", "X-Abw").
std::vector<LargestDrift> largest_drifts(const MeasuredDrift& drift);
std::vector<LargestDrift> largest_drifts(const DriftSeries& series);

}  // namespace ballbar
