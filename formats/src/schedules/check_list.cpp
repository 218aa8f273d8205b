#include "ballbar/formats/schedules/check_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/number_text.hpp"
#include "schedules/program_steps.hpp"

namespace ballbar {
namespace {

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

// A line a dwell: when, how long, how fast, and what is to be set.
std::string timetable(const Schedule& schedule) {
  std::string out = fmt::format("  {:>9}  {:>9}  {:>8}  {}\n", "from h:mm", "for h:mm", "rpm", "to set by hand");
  double begin_s = 0.0;
  Dwell before;
  for (const Dwell& dwell : schedule.dwells) {
    const int rpm = steps::whole_rpm(dwell.speed_rpm);
    std::string line = fmt::format("  {:>9}  {:>9}  {:>8}  {}", clock_text(begin_s), clock_text(dwell.duration_s),
                                   rpm == 0 ? "rest" : fmt::format("{}", rpm), order_text(before, dwell));
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
    begin_s += dwell.duration_s;
    before = dwell;
  }
  return out + fmt::format("  {:>9}  end\n", clock_text(begin_s));
}

// What comes on top of the schedule.
std::string on_top_text(const Schedule& schedule, const ProgramOptions& options) {
  std::size_t stops = 0, circles = 0;
  for (const steps::Step& step : steps::steps_of(schedule, options)) {
    if (std::holds_alternative<steps::Stop>(step)) ++stops;
    if (std::holds_alternative<steps::Circle>(step)) ++circles;
  }
  const auto counted = [](std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  if (stops == 0) return "the program runs without a stop";
  const std::string stops_text = counted(stops, "stop") + " for the operator";
  // A test is a circle either way.
  if (circles > 0) return fmt::format("{} and {} come on top", stops_text, counted(circles / 2, "ballbar test"));
  return stops_text + (stops == 1 ? " comes on top" : " come on top");
}

}  // namespace

std::string check_list(const Schedule& schedule, const ProgramOptions& options,
                       const std::vector<std::string>& columns_to_log, std::string_view title) {
  expect_schedule(schedule);
  steps::expect_options(schedule, options);
  const std::optional<BallbarTest>& test = options.ballbar;
  double highest_rpm = 0.0;
  for (const Dwell& dwell : schedule.dwells) highest_rpm = std::max(highest_rpm, dwell.speed_rpm);
  const bool by_hand = std::any_of(schedule.dwells.begin(), schedule.dwells.end(),
                                   [](const Dwell& one) { return !order_text(Dwell{}, one).empty(); });
  std::string out = title.empty() ? "Check list of a thermal test\n" : one_line(title) + "\n";
  const auto item = [&](std::string_view text) { out += fmt::format("[ ] {}\n", text); };

  out += fmt::format("{} in all; {}.\n\nBefore\n", duration_text(duration_s(schedule)), on_top_text(schedule, options));
  item(schedule.starts_warm ? "The machine is still warm from its previous work: start within minutes of its end."
                            : "The machine has been at rest for a night, powered, in the room of the test.");
  item(fmt::format("The tool in the spindle may turn at {} rpm; guards and door are closed while it turns.",
                   grouped_text(std::round(highest_rpm))));
  item(test ? "Clearances are checked: axes move only in the ballbar tests, first with a reduced feed override."
            : "Clearances are checked; no axis moves in the program.");
  if (test) {
    item(
        fmt::format("The zero of the workpiece (G54, preset) is the centre of the fixed ball; X{:.4g} Y0 can be "
                    "reached.",
                    test->radius_mm + test->feed_in_mm));
    item(fmt::format("Bar of {:.6g} mm, calibrated, at the room's temperature; feed {:.6g} mm/min, XY, CCW then CW.",
                     test->radius_mm, test->feed_mm_per_min));
  } else {
    item("The drift sensors are mounted and give readings; their range covers the expected drift (plan.svg).");
  }
  item("The clocks of the machine, of the loggers and of the ballbar's computer agree to a few seconds.");
  item("The machine's own thermal compensation is off, or its offsets are logged.");
  if (by_hand)
    item("Load, room and coolant can be set to the timetable, and their values in the previous data are known.");

  out += "\nLog from before the start until after the end, one file, one clock\n";
  item(fmt::format("time, as time_s or a time stamp; the target every {:.6g} s, all else at least as often",
                   schedule.reading_s));
  for (const std::string& column : columns_to_log) item(one_line(column));

  out += "\nDuring: hours and minutes since the start\n";
  out += timetable(schedule);
  out += "\n";
  item("Start the loggers, wait for ten readings at rest, start the program, write down the time of day: ______");
  if (by_hand) item("At each stop set the values of the message, note the time and the values reached, then restart.");
  if (test && test->every_min > 0.0) {
    item(
        fmt::format("A ballbar test at the start, every {:.6g} min and at the end; the bar is off while the spindle "
                    "turns.",
                    test->every_min));
  } else if (test) {
    item("A ballbar test at the start and after each dwell; the bar is off while the spindle turns.");
  }
  item("The override of the spindle's speed stays at 100 %.");
  item("Every deviation from the plan (door open, a pause, an alarm) is noted with its time.");

  out += "\nAfter\n";
  item("Let the loggers run for ten more minutes, then save.");
  item("Each column of the list is in the file, has its unit in its name and no long gap.");
  item("The spindle's speed in the file is that of the timetable.");
  if (test) item("Each ballbar recording has its own time.");
  item("Give the run to ballbar diagnose together with the data so far.");
  return out;
}

}  // namespace ballbar
