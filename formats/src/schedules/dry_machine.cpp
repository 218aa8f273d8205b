#include "schedules/dry_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"
#include "schedules/program_steps.hpp"

namespace ballbar {
namespace {

constexpr double kHighest_rpm = 1e6, kFarthest_mm = 1e5, kHighestFeed_mm_per_min = 1e6;
constexpr double kSamePlace_mm = 1e-4;

void add_wait(std::vector<Dwell>& dwells, double duration_s, double speed_rpm) {
  if (duration_s == 0.0) return;
  if (dwells.empty() || dwells.back().speed_rpm != speed_rpm) {
    dwells.push_back({.duration_s = 0.0, .speed_rpm = speed_rpm});
  }
  // Whole milliseconds, so that the sum of many blocks is the number that one block would have been.
  dwells.back().duration_s = std::round((dwells.back().duration_s + duration_s) * 1e3) / 1e3;
}

}  // namespace

void DryMachine::set_speed(double rpm) {
  if (!(rpm >= 0.0 && rpm <= kHighest_rpm)) fail(fmt::format("expected a speed of 0 to 1000000 rpm, found {}.", rpm));
  speed_rpm_ = rpm;
}

void DryMachine::turn() {
  if (speed_rpm_ == 0.0) fail("expected a speed before the spindle is started, found none.");
  turns_ = true;
  run_.highest_rpm = std::max(run_.highest_rpm, speed_rpm_);
}

void DryMachine::orient() {
  if (turns_) fail("expected the spindle at rest where it is oriented, found it turning.");
  ++run_.orientations;
}

void DryMachine::wait(double duration_s, double longest_s) {
  if (!(duration_s >= 0.0 && duration_s <= longest_s)) {
    fail(fmt::format("expected a dwell of 0 to {} s, found {}.", longest_s, duration_s));
  }
  run_.longest_wait_s = std::max(run_.longest_wait_s, duration_s);
  run_.duration_s = std::round((run_.duration_s + duration_s) * 1e3) / 1e3;
  add_wait(run_.dwells, duration_s, turns_ ? speed_rpm_ : 0.0);
}

void DryMachine::stop(std::string_view message) {
  if (turns_) fail("expected the spindle at rest at a programmed stop, found it turning.");
  run_.stops.emplace_back(message);
}

void DryMachine::set_feed(double feed_mm_per_min) {
  if (!(feed_mm_per_min > 0.0 && feed_mm_per_min <= kHighestFeed_mm_per_min)) {
    fail(fmt::format("expected a feed above 0, found {}.", feed_mm_per_min));
  }
  feed_mm_per_min_ = feed_mm_per_min;
}

void DryMachine::expect_to_move(std::string_view what) const {
  if (turns_) fail(fmt::format("expected the spindle at rest before {}, found it turning.", what));
  if (!has_zero_) fail(fmt::format("expected the workpiece's zero (G54) before {}, found none.", what));
  if (feed_mm_per_min_ == 0.0) fail(fmt::format("expected a feed before {}, found none.", what));
  if (run_.stops.empty()) fail(fmt::format("expected a stop for the operator before {}, found none.", what));
}

void DryMachine::move(double x_mm, double y_mm) {
  expect_to_move("a move");
  if (!(std::abs(x_mm) <= kFarthest_mm && std::abs(y_mm) <= kFarthest_mm)) {
    fail(fmt::format("expected a place within 100 m, found X{} Y{}.", x_mm, y_mm));
  }
  // The way to the first place is not known.
  if (x_mm_) run_.driven_s += std::hypot(x_mm - *x_mm_, y_mm - y_mm_) / feed_mm_per_min_ * 60.0;
  x_mm_ = x_mm;
  y_mm_ = y_mm;
}

void DryMachine::circle(double x_mm, double y_mm, double centre_x_mm, double centre_y_mm, bool is_ccw) {
  expect_to_move("an arc");
  if (!x_mm_ || !(std::hypot(x_mm - *x_mm_, y_mm - y_mm_) <= kSamePlace_mm)) {
    fail("expected an arc that ends where it begins, found another.");
  }
  DrivenCircle circle;
  circle.radius_mm = std::hypot(x_mm - centre_x_mm, y_mm - centre_y_mm);
  if (!(circle.radius_mm > 0.0 && circle.radius_mm <= kFarthest_mm)) {
    fail(fmt::format("expected a radius above 0, found {} mm.", circle.radius_mm));
  }
  circle.centre_x_mm = centre_x_mm;
  circle.centre_y_mm = centre_y_mm;
  circle.feed_mm_per_min = feed_mm_per_min_;
  circle.is_ccw = is_ccw;
  circle.after_s = run_.duration_s;
  run_.driven_s += 2.0 * kPi * circle.radius_mm / feed_mm_per_min_ * 60.0;
  run_.circles.push_back(circle);
}

std::vector<Dwell> driven_dwells(const Schedule& schedule) {
  std::vector<Dwell> dwells;
  double end_s = 0.0;
  long long at_ms = 0;
  for (const Dwell& dwell : schedule.dwells) {
    end_s += dwell.duration_s;
    const long long end_ms = std::llround(end_s * 1e3);
    add_wait(dwells, static_cast<double>(end_ms - at_ms) / 1e3, steps::whole_rpm(dwell.speed_rpm));
    at_ms = end_ms;
  }
  return dwells;
}

}  // namespace ballbar
