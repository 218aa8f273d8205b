#include "diagnosis/next_test/menu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "ballbar/number_text.hpp"
#include "ballbar/numerics/order_statistic.hpp"
#include "diagnosis/next_test/planned_inputs.hpp"
#include "numerics/random_streams.hpp"
#include "series/standstill.hpp"

namespace ballbar {
namespace {

constexpr std::array kHours{4.0, 8.0, 12.0, 24.0};
constexpr double kHour_s = 3600.0;
constexpr double kShortest_s = 600.0, kLongest_s = 7200.0;  // of a dwell
constexpr double kMostReadings = 2000.0;
constexpr double kRoomStep_K = 3.0, kCoolantStep_K = 3.0, kLoadStep = 2.0;
constexpr double kRounding_rpm = 50.0;

double reading_s_of(const Series& data, const std::string& target) {
  const std::vector<double>& values = find_column(data, target)->values;
  std::vector<double> gaps_s;
  double last_s = 0.0;
  bool any = false;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isnan(values[row])) continue;
    if (any && data.time_s[row] > last_s) gaps_s.push_back(data.time_s[row] - last_s);
    last_s = data.time_s[row];
    any = true;
  }
  return gaps_s.empty() ? 60.0 : median(std::move(gaps_s));
}

double rounded_rpm(double rpm) { return kRounding_rpm * std::round(rpm / kRounding_rpm); }

// Dwells of 10 min to 2 h, log-uniform, each at a different speed from the last, one in four at rest. They are the same
// for all machines, so that a plan is reproducible.
std::vector<Dwell> random_speeds(double hours, double max_rpm) {
  std::mt19937_64 random = simulation::stream_of(1, simulation::Stream::signal, 21);
  std::vector<Dwell> dwells{{1200.0, 0.0}};
  double left_s = hours * kHour_s - 1200.0, last_rpm = 0.0;
  while (left_s > 0.0) {
    const double drawn_s = kShortest_s * std::pow(kLongest_s / kShortest_s, simulation::uniform(random));
    double dwell_s = std::min(left_s, 60.0 * std::round(drawn_s / 60.0));
    if (left_s - dwell_s < kShortest_s) dwell_s = left_s;
    double rpm = last_rpm;
    while (std::abs(rpm - last_rpm) < 0.15 * max_rpm) {
      const double level = simulation::uniform(random);
      rpm = simulation::uniform(random) < 0.25 ? 0.0 : rounded_rpm((0.2 + 0.8 * level) * max_rpm);
    }
    dwells.push_back({dwell_s, rpm});
    left_s -= dwell_s;
    last_rpm = rpm;
  }
  return dwells;
}

// Up and down in fifths of the highest speed, as often as there is time for steps of half an hour, at least once.
std::vector<Dwell> staircase(double hours, double max_rpm) {
  constexpr std::array kSteps{0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 0.8, 0.6, 0.4, 0.2};
  const double rounds = std::max(1.0, std::floor(hours / 5.0));
  const double dwell_s = 60.0 * std::floor(hours * kHour_s / (rounds * kSteps.size()) / 60.0);
  std::vector<Dwell> dwells;
  for (double round = 0.0; round < rounds; round += 1.0) {
    for (const double share : kSteps) dwells.push_back({dwell_s, rounded_rpm(share * max_rpm)});
  }
  dwells.back().duration_s += hours * kHour_s - duration_s({dwells});
  return dwells;
}

// Full speed and rest by turns, first short, then long: 10 min to 2 h.
std::vector<Dwell> cycles(double hours, double max_rpm) {
  std::vector<Dwell> dwells{{1200.0, 0.0}};
  double left_s = hours * kHour_s - 1200.0, dwell_s = kShortest_s;
  bool turns = true;
  while (left_s > 0.0) {
    double now_s = std::min(left_s, 60.0 * std::round(dwell_s / 60.0));
    if (left_s - now_s < kShortest_s) now_s = left_s;
    dwells.push_back({now_s, turns ? max_rpm : 0.0});
    left_s -= now_s;
    if (!turns) dwell_s = dwell_s * 1.6 > kLongest_s ? kShortest_s : dwell_s * 1.6;
    turns = !turns;
  }
  return dwells;
}

// What can be moved beside the speed, each on a time of its own: on for as long as off.
void move(std::vector<Dwell>& dwells, double every_h, double Dwell::*what, double on, double off) {
  std::vector<Dwell> cut;
  double now_s = 0.0, next_s = every_h * kHour_s;
  bool is_on = false;
  for (Dwell dwell : dwells) {
    while (now_s + dwell.duration_s > next_s + 1.0) {
      Dwell part = dwell;
      part.duration_s = next_s - now_s;
      part.*what = is_on ? on : off;
      if (part.duration_s > 0.0) cut.push_back(part);
      dwell.duration_s -= part.duration_s;
      now_s = next_s;
      next_s += every_h * kHour_s;
      is_on = !is_on;
    }
    dwell.*what = is_on ? on : off;
    now_s += dwell.duration_s;
    cut.push_back(dwell);
  }
  dwells = std::move(cut);
}

struct TestKind {
  std::string name, doing;
  std::vector<Dwell> (*speeds)(double hours, double max_rpm);
  bool moved = false;
};

std::vector<Dwell> at_rest(double hours, double) { return {{hours * kHour_s, 0.0}}; }

std::vector<TestKind> kinds_of(double max_rpm, const TestPlanOptions& options) {
  std::string moved;
  const auto add = [&](bool can, std::string_view phrase) {
    if (can) moved += fmt::format("{}{}", moved.empty() ? "" : ", ", phrase);
  };
  add(options.can_room, fmt::format("the room {:g} K warmer and back", kRoomStep_K));
  add(options.can_coolant, fmt::format("the coolant {:g} K warmer and back", kCoolantStep_K));
  add(options.can_load && max_rpm > 0.0, fmt::format("{:g} times the load and back", kLoadStep));
  std::vector<TestKind> kinds;
  if (max_rpm > 0.0) {
    const std::string up_to = fmt::format("up to {} rpm", grouped_text(max_rpm));
    kinds.push_back({"random speeds", "speeds that change every 10 min to 2 h, " + up_to, random_speeds});
    kinds.push_back({"staircase", "a staircase of speeds " + up_to, staircase});
    kinds.push_back(
        {"stop and go", fmt::format("{} rpm and rest by turns, 10 min to 2 h each", grouped_text(max_rpm)), cycles});
    if (!moved.empty()) {
      kinds.push_back({"random speeds, " + moved, kinds.front().doing + "; " + moved, random_speeds, true});
    }
  } else {
    kinds.push_back({"at rest", "at rest", at_rest});
    if (!moved.empty()) kinds.push_back({"at rest, " + moved, "at rest; " + moved, at_rest, true});
  }
  return kinds;
}

double highest_rpm(const Series& data, const TestPlanOptions& options) {
  const Column* speed = first_speed(data);
  if (speed == nullptr) return 0.0;
  return options.max_rpm > 0.0 ? options.max_rpm : largest_of(speed->values);
}

}  // namespace

double duration_s(const Schedule& schedule) {
  double sum_s = 0.0;
  for (const Dwell& dwell : schedule.dwells) sum_s += dwell.duration_s;
  return sum_s;
}

const Dwell& dwell_at(const Schedule& schedule, double time_s) {
  double end_s = 0.0;
  for (const Dwell& dwell : schedule.dwells) {
    end_s += dwell.duration_s;
    if (time_s < end_s) return dwell;
  }
  return schedule.dwells.back();
}

std::vector<ExpectedTest> menu_of(const Series& data, const std::string& target, const TestPlanOptions& options) {
  const double max_rpm = highest_rpm(data, options), reading_s = reading_s_of(data, target);
  std::vector<double> lengths_h;
  for (const double hours : kHours) {
    if (hours < options.most_hours - 0.5) lengths_h.push_back(hours);
  }
  lengths_h.push_back(options.most_hours);
  std::vector<ExpectedTest> menu;
  for (const TestKind& kind : kinds_of(max_rpm, options)) {
    for (const double hours : lengths_h) {
      ExpectedTest item{kind.name, kind.doing, hours, {kind.speeds(hours, max_rpm), 0.0, false}};
      if (kind.moved && options.can_room) move(item.schedule.dwells, hours / 4.0, &Dwell::room_K, kRoomStep_K, 0.0);
      if (kind.moved && options.can_coolant)
        move(item.schedule.dwells, hours / 6.0, &Dwell::coolant_K, kCoolantStep_K, 0.0);
      if (kind.moved && options.can_load) move(item.schedule.dwells, hours / 10.0, &Dwell::load, kLoadStep, 1.0);
      item.schedule.reading_s = std::max(reading_s, hours * kHour_s / kMostReadings);
      menu.push_back(std::move(item));
    }
  }
  return menu;
}

}  // namespace ballbar
