// The schedule of a test, `schedule.csv`: one row per dwell.
//
//   # format = "ballbar-schedule 1"
//   # reading_s = 60.0
//   # starts = "cold"
//   begin_min,duration_min,speed_rpm,load,room_K,coolant_K
//   0,30,0,1,0,0
//   30,120,9000,1.5,0,2
#pragma once

#include <string>

#include "ballbar/diagnosis/next_test/plan.hpp"

namespace ballbar {

// Minutes have as many decimals as a microsecond needs. Throws Error as expect_schedule() does.
std::string write_schedule_csv(const Schedule& schedule);

// Limits: durations of at least 1 ms, speeds of 0 to 1 000 000 rpm, loads of 0 to 100, room and coolant within 100 K,
// at most 10 000 dwells and 31 days in all. Throws Error: "Dwell 3 of the schedule: expected ..., found ...".
void expect_schedule(const Schedule& schedule);

}  // namespace ballbar
