// A schedule as a program of a machine's control: the spindle turns, dwells and stops as the schedule says, and between
// the dwells a ballbar test may be driven.
//
// No axis moves but in the ballbar tests, and there only in the plane: from the start position X = R + feed-in, Y = 0
// in to X = R, a full circle CCW, out, in, a full circle CW, out. The zero of the workpiece (G54; the preset of
// Heidenhain) is the centre of the fixed ball. The axis Z stays where the operator left it. Before the first move, and
// with each bar that is mounted or taken off, the program stops (M0) with a message; it stops so, too, where load, room
// or coolant are to be set. At each such stop the spindle is at rest, on every control.
//
// Speeds are whole rpm, times whole milliseconds of the schedule's own clock, so that nothing adds up. Dwells are
// split into blocks of 5 minutes and less, each with a comment of the minutes that have passed; the time of the stops
// and the tests comes on top of the schedule.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ballbar/diagnosis/next_test/schedule.hpp"

namespace ballbar {

enum class Dialect {
  fanuc,
  siemens,     // SINUMERIK 840D, its own language
  heidenhain,  // TNC, plain language
  linuxcnc,
};
inline constexpr Dialect kDialects[] = {Dialect::fanuc, Dialect::siemens, Dialect::heidenhain, Dialect::linuxcnc};

std::string_view name_of(Dialect dialect);
std::string_view file_name_of(Dialect dialect);  // "fanuc.nc", "siemens.mpf", "heidenhain.h", "linuxcnc.ngc"

struct BallbarTest {
  double radius_mm = 100.0;  // of the path; the length of the bar
  double feed_mm_per_min = 1000.0;
  double feed_in_mm = 1.5;  // the start position is so far outside the circle
  // 0: a test before the first dwell and after each; else before the first, each time the schedule has gone on for so
  // long, and at the end.
  double every_min = 0.0;
  bool orient = false;  // the spindle is oriented before each test: M19, of Siemens SPOS, where the machine has it
};

struct ProgramOptions {
  std::string name = "WARMUP";  // of the program: its letters and digits, in capitals
  std::string title;            // a comment
  int number = 1100;            // Fanuc's O number, 1 to 9999
  std::optional<BallbarTest> ballbar;
  std::optional<double> max_rpm;
  std::optional<int> range_m;  // M function of the spindle's range, 40 to 49; LinuxCNC has none
};

// Plain ASCII, in capitals, lines of at most 80 characters that end in \n. Of the texts of the options other characters
// than letters, digits and "+-.,=" are blanks. Throws Error as expect_schedule, where a dwell is above max_rpm, and
// where an option is not what it may be.
std::string spindle_program(const Schedule& schedule, Dialect dialect, const ProgramOptions& options);

}  // namespace ballbar
