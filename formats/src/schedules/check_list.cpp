#include "ballbar/formats/schedules/check_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/internal/number_text.hpp"

namespace ballbar {
namespace {

constexpr double kLeastByBallbar_s = 300.0;  // readings that come faster are none of a ballbar that is mounted by hand

// "2:05", hours and minutes; "2:05:30" where it is no whole minute.
std::string clock_text(double time_s) {
  const long long whole_s = std::llround(time_s);
  const std::string text = fmt::format("{}:{:02}", whole_s / 3600, whole_s / 60 % 60);
  return whole_s % 60 == 0 ? text : text + fmt::format(":{:02}", whole_s % 60);
}

std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return line;
}

// A line a dwell: when, how long, how fast, and what is to be set.
std::string timetable(const Schedule& schedule) {
  std::string out = fmt::format("  {:>9}  {:>9}  {:>8}  {}\n", "from h:mm", "for h:mm", "rpm", "to set by hand");
  double begin_s = 0.0;
  Dwell before;
  for (const Dwell& dwell : schedule.dwells) {
    const long long rpm = std::llround(dwell.speed_rpm);
    std::string line = fmt::format("  {:>9}  {:>9}  {:>8}  {}", clock_text(begin_s), clock_text(dwell.duration_s),
                                   rpm == 0 ? "rest" : fmt::format("{}", rpm), order_text(before, dwell));
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
    begin_s += dwell.duration_s;
    before = dwell;
  }
  return out + fmt::format("  {:>9}  end\n", clock_text(begin_s));
}

}  // namespace

std::string order_text(const Dwell& before, const Dwell& now) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  const auto difference = [](double difference_K) {
    return difference_K == 0.0 ? std::string("as in the data so far") : fmt::format("{:+.4g} K", difference_K);
  };
  if (now.load != before.load) {
    add(now.load == 1.0 ? "load as in the data so far" : fmt::format("load {:.4g} times that of the data", now.load));
  }
  if (now.room_K != before.room_K) add("room " + difference(now.room_K));
  if (now.coolant_K != before.coolant_K) add("coolant " + difference(now.coolant_K));
  return text;
}

std::string check_list(const Schedule& schedule, const std::vector<std::string>& columns_to_log,
                       std::string_view title) {
  expect_schedule(schedule);
  double highest_rpm = 0.0;
  std::size_t stops = 0;
  Dwell before;
  for (const Dwell& dwell : schedule.dwells) {
    highest_rpm = std::max(highest_rpm, dwell.speed_rpm);
    if (!order_text(before, dwell).empty()) ++stops;
    before = dwell;
  }
  const bool by_ballbar = schedule.reading_s >= kLeastByBallbar_s;
  std::string out = title.empty() ? "Check list of a thermal test\n" : one_line(title) + "\n";
  const auto item = [&](std::string_view text) { out += fmt::format("[ ] {}\n", text); };

  out += fmt::format("{} in all; {}.\n\nBefore\n", duration_text(duration_s(schedule)),
                     stops == 0   ? "once started, the program runs without a stop"
                     : stops == 1 ? "1 stop for the operator comes on top"
                                  : fmt::format("{} stops for the operator come on top", stops));
  item(schedule.starts_warm ? "The machine is still warm from its previous work: start within minutes of its end."
                            : "The machine has been at rest for a night, powered, in the room of the test.");
  item(fmt::format("The tool in the spindle may turn at {} rpm; guards and door are closed while it turns.",
                   grouped_text(std::round(highest_rpm))));
  item("Clearances are checked; no axis moves in the program.");
  item(
      "G4 P10 at the start of program.nc takes 10 s by a watch. Controls differ: if it does not, all dwells are "
      "changed "
      "to the control's own word and unit.");
  item("The drift sensors are mounted and give readings; their range covers the expected drift (plan.svg).");
  item("The clocks of the machine, of the loggers and of the ballbar's computer agree to a few seconds.");
  item("The machine's own thermal compensation is off, or its offsets are logged.");
  if (stops > 0)
    item("Load, room and coolant can be set to the timetable, and their values in the previous data are known.");

  out += "\nLog from before the start until after the end, one file, one clock\n";
  item(fmt::format("time, as time_s or a time stamp; the target every {:.6g} s, all else at least as often",
                   schedule.reading_s));
  for (const std::string& column : columns_to_log) item(one_line(column));

  out += "\nDuring: hours and minutes since the start\n";
  out += timetable(schedule);
  out += "\n";
  item(
      "Start the loggers, wait for ten readings at rest, start the program, go on at its first stop, write down the "
      "time of day: ______");
  if (stops > 0)
    item("At each stop set the values of the comment, note the time and the values reached, then restart.");
  if (by_ballbar) {
    item(
        fmt::format("If ballbar tests give the target: one at the start, every {:.6g} min and at the end. Program and "
                    "spindle stop for it; the bar is off while the spindle turns.",
                    schedule.reading_s / 60.0));
  }
  item("The override of the spindle's speed stays at 100 %.");
  item("Every deviation from the plan (door open, a pause, an alarm) is noted with its time.");

  out += "\nAfter\n";
  item("Let the loggers run for ten more minutes, then save.");
  item("Each column of the list is in the file, has its unit in its name and no long gap.");
  item("The spindle's speed in the file is that of the timetable.");
  if (by_ballbar) item("Each ballbar recording has its own time.");
  item("Give the run to ballbar diagnose together with the data so far.");
  return out;
}

}  // namespace ballbar
