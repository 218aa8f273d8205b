// Writes a schedule as a program for the control of a machine. The spindle turns, dwells and stops by the schedule;
// ballbar tests may take place between the dwells.
//
// Axes move only in the ballbar tests, and only in the plane: from the start position X = R + feed-in, Y = 0 in to
// X = R, a full circle CCW, out, in, a full circle CW, out. The zero of the workpiece (G54; the preset of Heidenhain)
// is the centre of the fixed ball. The Z axis does not move. The program stops (M0) with a message before the first
// move, whenever the bar is to be mounted or removed, and whenever load, room or coolant are to be set. At each such
// stop the spindle is at rest, on every control.
//
// Speeds are whole rpm. Times are whole milliseconds on the clock of the schedule, so that rounding errors do not add
// up. Dwells are split into blocks of at most 5 minutes, each with a comment of the minutes passed. Stops and tests
// take extra time.
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
  double feed_in_mm = 1.5;  // distance of the start position from the circle
  // 0: a test before the first dwell and after each dwell. Else a test before the first dwell, after every such
  // interval of the schedule, and at the end.
  double every_min = 0.0;
  bool orient = false;  // orient the spindle before each test: M19, for Siemens SPOS
};

struct ProgramOptions {
  std::string name = "WARMUP";  // of the program: its letters and digits, in capitals
  std::string title;            // a comment
  int number = 1100;            // Fanuc's O number, 1 to 9999
  std::optional<BallbarTest> ballbar;
  std::optional<double> max_rpm;
  std::optional<int> range_m;  // M function of the spindle's range, 40 to 49; LinuxCNC has none
};

// The text is ASCII in capitals, with lines of at most 80 characters that end in \n. In the texts of the options all
// characters but letters, digits and "+-.,=" become blanks. Throws Error as expect_schedule() does, for a speed above
// max_rpm, and for an invalid option.
std::string spindle_program(const Schedule& schedule, Dialect dialect, const ProgramOptions& options);

}  // namespace ballbar
