#include "schedules/program_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"

namespace ballbar::steps {
namespace {

constexpr std::size_t kLongestText = 64;           // with what stands around it a line has at most 80 characters
constexpr long long kLongestWait_ms = 300 * 1000;  // below what any control takes, and the comments say where it is

std::string minutes_text(long long time_ms) {
  const double min = std::round(static_cast<double>(time_ms) / 6e3) / 10.0;
  return fmt::format("{}", min);
}

// To the hundredth of an hour.
std::string hours_text(long long time_ms) {
  return fmt::format("{}", std::round(static_cast<double>(time_ms) / 36e3) / 100.0);
}

std::string difference_text(double difference_K) {
  return difference_K == 0.0 ? "AS BEFORE" : fmt::format("{:+.4g} K", difference_K);
}

struct Steps {
  std::vector<Step> list;
  long long total_ms = 0;
  int speed_rpm = -1;  // at first not known
  int tests = 0;

  // Whatever stands in it, no text ends a comment or says more than a comment.
  void say(std::string_view text) { list.emplace_back(Comment{plain_text(text, kLongestText)}); }

  void turn(int rpm) {
    if (rpm == speed_rpm) return;
    if (rpm > 0) list.emplace_back(Turn{rpm});
    if (rpm == 0) list.emplace_back(Rest{});
    speed_rpm = rpm;
  }

  // Nobody is asked to come near a spindle that turns.
  void stop(std::string_view message) {
    turn(0);
    list.emplace_back(Stop{plain_text(message, kLongestText)});
  }

  void test(const BallbarTest& test, long long at_ms) {
    const double r_mm = test.radius_mm, out_mm = test.radius_mm + test.feed_in_mm, feed = test.feed_mm_per_min;
    turn(0);
    ++tests;
    say(fmt::format("BALLBAR TEST {} AFTER {} MIN", tests, minutes_text(at_ms)));
    if (test.orient) list.emplace_back(Orient{});
    stop(fmt::format("MOUNT THE BAR, START ITS CAPTURE - TEST {}", tests));
    for (const bool is_ccw : {true, false}) {
      list.emplace_back(Line{r_mm, feed});
      list.emplace_back(Circle{r_mm, is_ccw});
      list.emplace_back(Line{out_mm, feed});
    }
    stop("TAKE THE BAR OFF, SAVE THE CAPTURE, CLOSE THE DOOR");
  }
};

void head(Steps& steps, const Schedule& schedule, const ProgramOptions& options) {
  const auto say = [&](std::string_view text) { steps.say(text); };
  int highest_rpm = 0;
  for (const Dwell& dwell : schedule.dwells) highest_rpm = std::max(highest_rpm, whole_rpm(dwell.speed_rpm));
  say("SPINDLE PROGRAM OF A THERMAL TEST, WRITTEN BY BALLBAR");
  if (!options.title.empty()) say("TITLE " + options.title);
  say(fmt::format("{} DWELLS, {} H IN ALL, STOPS AND TESTS NOT COUNTED", schedule.dwells.size(),
                  hours_text(steps.total_ms)));
  say(fmt::format("HIGHEST SPEED {} RPM - THE TOOL IN THE SPINDLE MUST BEAR IT", highest_rpm));
  say("CHECK CLEARANCES - NO AXIS MOVES BUT IN THE BALLBAR TESTS");
  say(schedule.starts_warm ? "BEGIN WHILE THE MACHINE IS STILL WARM FROM WHAT IT DID BEFORE"
                           : "BEGIN AFTER A NIGHT AT REST");
  if (!options.ballbar) return say("NO BALLBAR TEST IN THIS PROGRAM, NO AXIS MOVES");
  const BallbarTest& test = *options.ballbar;
  say(fmt::format("BALLBAR TESTS - RADIUS {:.4g} MM, FEED {:.6g} MM PER MIN, PLANE XY", test.radius_mm,
                  test.feed_mm_per_min));
  say("WORKPIECE ZERO IS THE CENTRE OF THE FIXED BALL, Z IS NOT MOVED");
}

// What differs from before, as an order to the operator; empty where nothing does.
std::string setting(const Dwell& before, const Dwell& now) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "SET " : ", ") + what; };
  if (now.load != before.load) add(now.load == 1.0 ? "LOAD AS BEFORE" : fmt::format("LOAD {:.4g} TIMES", now.load));
  if (now.room_K != before.room_K) add("ROOM " + difference_text(now.room_K));
  if (now.coolant_K != before.coolant_K) add("COOLANT " + difference_text(now.coolant_K));
  return text;
}

void expect_in(std::string_view what, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  throw Error(fmt::format("A program's {}: expected {} to {}, found {}.", what, lowest, highest, value));
}

}  // namespace

int whole_rpm(double speed_rpm) { return static_cast<int>(std::lround(speed_rpm)); }

std::string plain_text(std::string_view text, std::size_t most) {
  std::string plain;
  for (const char c : text) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_other = (c >= '0' && c <= '9') || std::string_view("+-.,=").find(c) != std::string_view::npos;
    if (plain.size() == most) break;
    if (is_letter || is_other) {
      plain += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    } else if (!plain.empty() && plain.back() != ' ') {
      plain += ' ';
    }
  }
  while (plain.ends_with(' ')) plain.pop_back();
  return plain;
}

void expect_options(const Schedule& schedule, const ProgramOptions& options) {
  expect_in("O number", options.number, 1, 9999);
  if (options.range_m) expect_in("M function of the spindle's range", *options.range_m, 40, 49);
  if (options.ballbar) {
    const BallbarTest& test = *options.ballbar;
    expect_in("radius in mm", test.radius_mm, 10.0, 2000.0);
    expect_in("feed in mm/min", test.feed_mm_per_min, 1.0, 50000.0);
    expect_in("way of feeding in, in mm", test.feed_in_mm, 0.1, 10.0);
    if (test.every_min != 0.0) expect_in("minutes between two tests", test.every_min, 1.0, 44640.0);
  }
  if (!options.max_rpm) return;
  double begin_s = 0.0;
  for (std::size_t i = 0; i < schedule.dwells.size(); ++i) {
    const Dwell& dwell = schedule.dwells[i];
    if (!(whole_rpm(dwell.speed_rpm) <= *options.max_rpm)) {
      throw Error(
          fmt::format("Dwell {} of the schedule, from {:.4g} min: expected at most {} rpm, the highest that the "
                      "machine may turn, found {} rpm.",
                      i + 1, begin_s / 60.0, *options.max_rpm, dwell.speed_rpm));
    }
    begin_s += dwell.duration_s;
  }
}

std::vector<Step> steps_of(const Schedule& schedule, const ProgramOptions& options) {
  const auto ms_of = [](double time_s) { return std::llround(time_s * 1e3); };
  Steps steps;
  steps.total_ms = ms_of(duration_s(schedule));
  head(steps, schedule, options);
  const std::optional<BallbarTest>& test = options.ballbar;
  const long long every_ms = test ? ms_of(test->every_min * 60.0) : 0;
  if (test) {
    const double start_mm = test->radius_mm + test->feed_in_mm;
    steps.stop(fmt::format("NEXT THE AXES GO TO X{:.4g} Y0 - CHECK ZERO, HEIGHT, WAY", start_mm));
    steps.list.emplace_back(Line{start_mm, test->feed_mm_per_min});
    steps.test(*test, 0);
  }
  double begin_s = 0.0;
  Dwell before;
  long long at_ms = 0, next_test_ms = every_ms;
  for (std::size_t i = 0; i < schedule.dwells.size(); ++i) {
    const Dwell& dwell = schedule.dwells[i];
    const int rpm = whole_rpm(dwell.speed_rpm);
    begin_s += dwell.duration_s;
    const long long end_ms = ms_of(begin_s);
    const std::string time = end_ms - at_ms < 60000 ? fmt::format("{} S", static_cast<double>(end_ms - at_ms) / 1e3)
                                                    : minutes_text(end_ms - at_ms) + " MIN";
    steps.say(fmt::format("DWELL {} OF {} - {} AT {} RPM", i + 1, schedule.dwells.size(), time, rpm));
    if (const std::string order = setting(before, dwell); !order.empty()) steps.stop(order);
    before = dwell;
    while (at_ms < end_ms) {
      steps.turn(rpm);
      long long until_ms = std::min(end_ms, at_ms + kLongestWait_ms);
      if (every_ms > 0) until_ms = std::min(until_ms, next_test_ms);
      steps.list.emplace_back(Wait{until_ms - at_ms});
      at_ms = until_ms;
      steps.say(fmt::format("{} OF {} MIN", minutes_text(at_ms), minutes_text(steps.total_ms)));
      const bool is_end = at_ms == end_ms && i + 1 == schedule.dwells.size();
      const bool is_due = every_ms > 0 ? at_ms == next_test_ms || is_end : at_ms == end_ms;
      if (every_ms > 0 && at_ms == next_test_ms) next_test_ms += every_ms;
      if (test && is_due) steps.test(*test, at_ms);
    }
  }
  steps.turn(0);
  return std::move(steps.list);
}

}  // namespace ballbar::steps
