// A dry run of a program from spindle_program(): reads back what it does, in the units and words of its control.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/formats/schedules/spindle_program.hpp"

namespace ballbar {

struct DrivenCircle {
  double radius_mm = 0.0, centre_x_mm = 0.0, centre_y_mm = 0.0;
  double feed_mm_per_min = 0.0;
  bool is_ccw = true;
  double after_s = 0.0;  // dwells before it
};

struct DryRun {
  std::vector<Dwell> dwells;  // speed and duration; consecutive waits at one speed are merged
  double duration_s = 0.0;    // of all dwells dwells
  double highest_rpm = 0.0;
  double driven_s = 0.0;           // duration of the axis moves
  double longest_wait_s = 0.0;     // longest wait in one block
  int orientations = 0;            // of the spindle
  std::vector<std::string> stops;  // the message of each programmed stop
  std::vector<DrivenCircle> circles;
};

// Knows only the words that such programs use; it is not an interpreter for the control. Throws Error with
// name:line:column: an unknown word, a stop or a move while the spindle turns, a wait longer than the control accepts,
// a move before G54 or without a feed, an arc that is not a full circle, a program without an end.
DryRun dry_run_of(std::string_view program, Dialect dialect, std::string_view name = "program");

// The dwells of a schedule as a dry run returns them: whole rpm, whole milliseconds, equal consecutive speeds merged.
std::vector<Dwell> driven_dwells(const Schedule& schedule);

}  // namespace ballbar
