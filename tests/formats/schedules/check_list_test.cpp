#include "ballbar/formats/schedules/check_list.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

TEST(check_list, whole) {
  const Schedule schedule{.dwells = {{.duration_s = 1800.0},
                                     {.duration_s = 5400.0, .speed_rpm = 12000.0, .load = 1.5, .room_K = 3.0},
                                     {.duration_s = 90.0, .speed_rpm = 3000.0}},
                          .reading_s = 1200.0};
  EXPECT_EQ(check_list(schedule, {"T_room_degC", "speed_rpm"}, "Which\nof two"), R"(Which of two
2 h 2 min in all; 2 stops for the operator come on top.

Before
[ ] The machine has been at rest for a night, powered, in the room of the test.
[ ] The tool in the spindle may turn at 12 000 rpm; guards and door are closed while it turns.
[ ] Clearances are checked; no axis moves in the program.
[ ] G4 P10 at the start of program.nc takes 10 s by a watch. Controls differ: if it does not, all dwells are changed to the control's own word and unit.
[ ] The drift sensors are mounted and give readings; their range covers the expected drift (plan.svg).
[ ] The clocks of the machine, of the loggers and of the ballbar's computer agree to a few seconds.
[ ] The machine's own thermal compensation is off, or its offsets are logged.
[ ] Load, room and coolant can be set to the timetable, and their values in the previous data are known.

Log from before the start until after the end, one file, one clock
[ ] time, as time_s or a time stamp; the target every 1200 s, all else at least as often
[ ] T_room_degC
[ ] speed_rpm

During: hours and minutes since the start
  from h:mm   for h:mm       rpm  to set by hand
       0:00       0:30      rest
       0:30       1:30     12000  load 1.5 times that of the data, room +3 K
       2:00    0:01:30      3000  load as in the data so far, room as in the data so far
    2:01:30  end

[ ] Start the loggers, wait for ten readings at rest, start the program, go on at its first stop, write down the time of day: ______
[ ] At each stop set the values of the comment, note the time and the values reached, then restart.
[ ] If ballbar tests give the target: one at the start, every 20 min and at the end. Program and spindle stop for it; the bar is off while the spindle turns.
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

TEST(check_list, warm_and_without_stops) {
  const std::string text = check_list({.dwells = {{.duration_s = 60.0}}, .starts_warm = true}, {}, "");
  EXPECT_TRUE(text.starts_with(
      "Check list of a thermal test\n1 min in all; once started, the program runs without a stop.\n\nBefore\n"
      "[ ] The machine is still warm from its previous work: start within minutes of its end.\n"))
      << text;
  EXPECT_EQ(text.find("bar is off"), std::string::npos);
  EXPECT_EQ(text.find("Load, room"), std::string::npos);
  EXPECT_NE(check_list({.dwells = {{.duration_s = 60.0, .load = 2.0}}}, {}, "").find("1 stop for the operator comes"),
            std::string::npos);
  EXPECT_THROW(check_list({}, {}, ""), Error);
}

}  // namespace
}  // namespace ballbar
