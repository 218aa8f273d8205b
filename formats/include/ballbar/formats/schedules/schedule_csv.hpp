// What a machine is to do in a test, `schedule.csv`: a row a dwell.
//
//   # format = "ballbar-schedule 1"
//   # reading_s = 60.0
//   # starts = "cold"
//   begin_min,duration_min,speed_rpm,load,room_K,coolant_K
//   0,30,0,1,0,0
//   30,120,9000,1.5,0,2
//
// Only duration_min and speed_rpm are needed, so that one can be written by hand; the columns may stand in any order.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/diagnosis/next_test/schedule.hpp"

namespace ballbar {

// Durations are to the microsecond: what is written reads back to the same doubles where they are whole microseconds,
// and else to the nearest one. Throws Error where the schedule is not one that can be read: see expect_schedule.
std::string write_schedule_csv(const Schedule& schedule);

// `name` stands in messages. Throws Error with name:line:column: another format, a key or a column that is not known, a
// begin_min that is not the end of the row before (to 0.001 min), a value out of its limits: durations of 1 ms and
// more, speeds of 0 to 1 000 000 rpm, a load of 0 to 100, room and coolant within 100 K; at most 10 000 dwells and 31
// days in all.
Schedule read_schedule_csv(std::string_view bytes, std::string_view name);

// The same limits of a schedule that no file holds. Throws Error: "Dwell 3 of the schedule: expected ..., found ...".
void expect_schedule(const Schedule& schedule);

}  // namespace ballbar
