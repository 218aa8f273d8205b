// What a program of spindle_program does, read back from its text in the units and words of its control.
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
  std::vector<Dwell> dwells;  // speed and duration; waits at one speed in a row are one, whatever stands between
  double duration_s = 0.0;    // of all
  double highest_rpm = 0.0;
  double driven_s = 0.0;           // the axes' ways at their feeds
  double longest_wait_s = 0.0;     // of one block
  int orientations = 0;            // of the spindle
  std::vector<std::string> stops;  // the message of each programmed stop
  std::vector<DrivenCircle> circles;
};

// Knows the words that such programs have and no others: it is no interpreter of the control. Throws Error with
// name:line:column at a word that it does not know, a stop or a move while the spindle turns, a wait longer than the
// control takes, a move before G54 or without a feed, an arc that is no full circle, a program without its end.
DryRun dry_run_of(std::string_view program, Dialect dialect, std::string_view name = "program");

// The dwells of a schedule as a dry run has them: whole rpm, whole milliseconds, equal speeds in a row are one.
std::vector<Dwell> driven_dwells(const Schedule& schedule);

}  // namespace ballbar
