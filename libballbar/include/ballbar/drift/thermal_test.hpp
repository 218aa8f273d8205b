// A drift as the sheet of a thermal test has it: which test of ISO 230-3 it is and what it lacks, the largest drifts,
// from when on it is stable, and the course of sizes without any input.
//
//   thermal_test()    kind of test, temperatures, speeds, lacks
//   largest_drifts()  x, y, z and combined, from the smooth curve
//   settling_of()     when each axis is stable
//   course_of()       trend, decay or steps of a series of parts
//
// ---- Which thermal test a record is, what it lacks, and the numbers of its sheet.
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

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/drift.hpp"
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

// ---- When a drift is stable: from which time on it stays within a band of its final value at the same speed.
//
// The drift of a stretch of one speed is one settling curve or two, and noise (t from its first row):
//
//   d(t) = c + a_1 exp(-t / tau_1) + a_2 exp(-t / tau_2),      t_s: the last time with |d(t) - c| = band
//
// One curve and two are fitted by least squares (Levenberg-Marquardt) and averaged by exp(-BIC / 2). Two curves that
// the rows do not tell apart are left out. The sigma of t_s is by the law of propagation from the covariance of the
// fit, with the variance of Student's t. If the residual r_i is autocorrelated, the variance is (1 + r) / (1 - r) times
// as large, r the correlation of neighbouring rows.
//
// Accuracy: of simulated records (tau 10 to 60 min, rows every 1 to 20 min, stretches of 1.5 to 7 tau, noise of 0.05 to
// 0.35 um) t_s is within 2 sigma of the truth in 92 to 97 %. Of more than 2000 rows the means of neighbours are fitted.
//
// Source: averaging over models, J. A. Hoeting et al., Statistical Science 14 (1999).

struct StableTime {
  double band_um = 0.0;
  double time_s = 0.0;  // from the first row of the stretch; 0: from the start
  double sigma_s = 0.0;
  bool reached = false;   // the stretch lasts longer than that
  double final_um = 0.0;  // c - d(0): what the drift of the stretch tends to
  double final_sigma_um = 0.0;
  double share_at_end = 0.0;  // of it, at the last row of the stretch
};

// Of rows with rising times, NaN: a gap. nullopt: fewer than 6 rows; the sigma is above half of the time; or
// the time lies beyond the rows, and they end before three quarters of the final value, where a trend or half a cycle
// look like a curve that settles.
std::optional<StableTime> stable_time(std::span<const double> time_s, std::span<const double> drift_um, double band_um);

struct AxisSettling {
  std::string axis;
  double band_um = 0.0;
  bool is_small = false;  // the whole stretch lies within the band
  std::optional<StableTime> stable;
};

// Of each axis in um over the rows [begin, end) of one speed. Without a speed column the stretch ends where the drift
// leaves the band about its largest value and does not come back, if that is in the second half. band_um: default the
// larger of 2 um and 10 % of the range of the axis.
std::vector<AxisSettling> settling_of(const MeasuredDrift& drift, std::size_t begin, std::size_t end,
                                      std::optional<double> band_um = std::nullopt);

// ---- The course of readings without any input, such as the sizes of a shift's parts: a trend, a curve that settles,
// steps.
//
//   y(t) = a + b t + steps             trend        (wear of a tool; a drift that goes on)
//   y(t) = a + c exp(-t / tau) + steps decay        (warming up; running in)
//   y(t) = a + steps                   still
//
// Least squares. At most three steps, each where it lowers the sum of squares most beside the others, at least three
// readings from the ends and from each other. If the best of them leaves more than twice the scatter of neighbouring
// rows, none is the course. Shapes and steps by BIC, where a step costs three parameters (Zhang and Siegmund,
// Biometrics 63 (2007) 22) and the n readings count as n (1 - r) / (1 + r), r the correlation of neighbouring
// residuals. The probability of a shape is exp(-BIC / 2) over the sum of the three. The sigmas are those of the fit,
// times (1 + r) / (1 - r) in variance.
//
// Readings alone do not tell why a size changes: thermal growth, wear and a changed set-up may have one course.

enum class CourseShape { still, trend, decay, none };
std::string_view name_of(CourseShape shape);

struct CourseStep {
  double time_s = 0.0;  // of the first reading after it
  Estimate size;
};

struct Course {
  std::string axis;                        // of a drift; empty: of readings alone
  CourseShape shape = CourseShape::still;  // the most probable
  double probability = 0.0;
  Estimate trend_um_per_h;       // of the shape trend, whatever the most probable one is
  Estimate decay;                // decay: -c, the change in the end
  double time_constant_s = 0.0;  // tau
  std::vector<CourseStep> steps;
  double noise_um = 0.0;  // standard deviation of the residual; none: scatter of neighbouring rows
  double left_um = 0.0;   // none: what the best of the shapes leaves
};

// Of rows with rising times, NaN: a gap. More than 2000 rows: means of neighbours. nullopt: fewer than 8 rows.
std::optional<Course> course_of(std::span<const double> time_s, std::span<const double> value_um);

}  // namespace ballbar
