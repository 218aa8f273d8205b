#include "ballbar/formats/schedules/check_list.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

TEST(check_list, whole) {
  const Schedule schedule{.dwells = {{.duration_s = 1800.0},
                                     {.duration_s = 5400.0, .speed_rpm = 12000.0, .load = 1.5, .room_K = 3.0},
                                     {.duration_s = 90.0, .speed_rpm = 3000.0}},
                          .reading_s = 30.0};
  EXPECT_EQ(
      check_list(schedule, {.ballbar = BallbarTest{.every_min = 20.0}}, {"T_room_degC", "speed_rpm"}, "Which\nof two"),
      R"(Which of two
2 h 2 min in all; 19 stops for the operator and 8 ballbar tests come on top.

Before
[ ] The machine has been at rest for a night, powered, in the room of the test.
[ ] The tool in the spindle may turn at 12 000 rpm; guards and door are closed while it turns.
[ ] Clearances are checked: axes move only in the ballbar tests, first with a reduced feed override.
[ ] The zero of the workpiece (G54, preset) is the centre of the fixed ball; X101.5 Y0 can be reached.
[ ] Bar of 100 mm, calibrated, at the room's temperature; feed 1000 mm/min, XY, CCW then CW.
[ ] The clocks of the machine, of the loggers and of the ballbar's computer agree to a few seconds.
[ ] The machine's own thermal compensation is off, or its offsets are logged.
[ ] Load, room and coolant can be set to the timetable, and their values in the previous data are known.

Log from before the start until after the end, one file, one clock
[ ] time, as time_s or a time stamp; the target every 30 s, all else at least as often
[ ] T_room_degC
[ ] speed_rpm

During: hours and minutes since the start
  from h:mm   for h:mm       rpm  to set by hand
       0:00       0:30      rest
       0:30       1:30     12000  load 1.5 times that of the data, room +3 K
       2:00    0:01:30      3000  load as in the data so far, room as in the data so far
    2:01:30  end

[ ] Start the loggers, wait for ten readings at rest, start the program, write down the time of day: ______
[ ] At each stop set the values of the message, note the time and the values reached, then restart.
[ ] A ballbar test at the start, every 20 min and at the end; the bar is off while the spindle turns.
[ ] The override of the spindle's speed stays at 100 %.
[ ] Every deviation from the plan (door open, a pause, an alarm) is noted with its time.

After
[ ] Let the loggers run for ten more minutes, then save.
[ ] Each column of the list is in the file, has its unit in its name and no long gap.
[ ] The spindle's speed in the file is that of the timetable.
[ ] Each ballbar recording has its own time.
[ ] Give the run to ballbar diagnose together with the data so far.
)");
}

TEST(check_list, warm_and_without_a_bar) {
  const std::string text = check_list({.dwells = {{.duration_s = 60.0}}, .starts_warm = true}, {}, {}, "");
  EXPECT_TRUE(
      text.starts_with("Check list of a thermal test\n1 min in all; the program runs without a stop.\n\nBefore\n"
                       "[ ] The machine is still warm from its previous work: start within minutes of its end.\n"))
      << text;
  EXPECT_EQ(text.find("bar is off"), std::string::npos);
  EXPECT_EQ(text.find("Load, room"), std::string::npos);
  EXPECT_THROW(check_list({}, {}, {}, ""), Error);
}

}  // namespace
}  // namespace ballbar
