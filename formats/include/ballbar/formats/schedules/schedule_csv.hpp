// The schedule of a test, `schedule.csv`: one row per dwell.
//
//   # format = "ballbar-schedule 1"
//   # reading_s = 60.0
//   # starts = "cold"
//   begin_min,duration_min,speed_rpm,load,room_K,coolant_K
//   0,30,0,1,0,0
//   30,120,9000,1.5,0,2
//
// Only duration_min and speed_rpm are required, so that a schedule can be written by hand. Columns are in any order.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/diagnosis/next_test/schedule.hpp"

namespace ballbar {

// Durations are rounded to microseconds; whole microseconds read back exactly. Throws Error as expect_schedule() does.
std::string write_schedule_csv(const Schedule& schedule);

// `name` is used in messages. Throws Error with name:line:column: another format, an unknown key or column, a begin_min
// that is not the end of the previous row (within 0.001 min), a value outside its limits. Limits: durations of at least
// 1 ms, speeds of 0 to 1 000 000 rpm, loads of 0 to 100, room and coolant within 100 K, at most 10 000 dwells and 31
// days in all.
Schedule read_schedule_csv(std::string_view bytes, std::string_view name);

// Checks the same limits for a schedule in memory. Throws Error: "Dwell 3 of the schedule: expected ..., found ...".
void expect_schedule(const Schedule& schedule);

}  // namespace ballbar
