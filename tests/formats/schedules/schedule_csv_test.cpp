#include "ballbar/formats/schedules/schedule_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/reader.hpp"

namespace ballbar {
namespace {

constexpr const char* kText = R"(# format = "ballbar-schedule 1"
# reading_s = 30.0
# starts = "warm"
begin_min,duration_min,speed_rpm,load,room_K,coolant_K
0,30,0,1,0,0
30,0.33333333,9000,1.5,0,-2
30.33333333,120,4500.5,1,0.25,0
)";

TEST(schedule_csv, what_is_written_is_this) {
  const Schedule schedule{.dwells = {{.duration_s = 1800.0},
                                     {.duration_s = 20.0, .speed_rpm = 9000.0, .load = 1.5, .coolant_K = -2.0},
                                     {.duration_s = 7200.0, .speed_rpm = 4500.5, .room_K = 0.25}},
                          .reading_s = 30.0,
                          .starts_warm = true};
  EXPECT_EQ(write_schedule_csv(schedule), kText);
}

TEST(schedule_csv, the_list_of_readers_knows_it) { EXPECT_EQ(found_in(reader_of(kText)), "the schedule of a test"); }

TEST(schedule_csv, what_no_file_holds_is_not_written) {
  const std::pair<Schedule, const char*> table[] = {
      {{}, "The schedule: expected 1 to 10000 dwells, found 0."},
      {{.dwells = {{.duration_s = 60.0}, {.duration_s = 0.0}}},
       "Dwell 2 of the schedule: expected a duration of 1 ms to 31 days, found 0 s."},
      {{.dwells = {{.duration_s = NAN}}},
       "Dwell 1 of the schedule: expected a duration of 1 ms to 31 days, found nan s."},
      {{.dwells = {{.duration_s = 60.0, .speed_rpm = INFINITY}}},
       "Dwell 1 of the schedule: expected a speed of 0 to 1000000 rpm, found inf."},
      {{.dwells = {{.duration_s = 2e6}, {.duration_s = 2e6}}},
       "The schedule: expected 31 days at most, found 46.2962962962963 days."},
      {{.dwells = {{.duration_s = 60.0}}, .reading_s = 0.0},
       "The schedule: expected a reading every 1 ms to 31 days, found every 0 s."},
  };
  for (const auto& [schedule, message] : table) {
    try {
      write_schedule_csv(schedule);
      ADD_FAILURE() << message;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), message);
    }
  }
}

}  // namespace
}  // namespace ballbar
