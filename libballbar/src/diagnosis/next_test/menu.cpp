#include "diagnosis/next_test/menu.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
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
  std::vector<double> known_s;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isnan(values[row])) known_s.push_back(data.time_s[row]);
  }
  const double step_s = median_step_s(known_s);
  return step_s > 0.0 ? step_s : 60.0;
}

double rounded_rpm(double rpm) { return kRounding_rpm * std::round(rpm / kRounding_rpm); }

// At rest for 20 min, then dwells of 10 min to 2 h, as next() has them.
template <class Next>
std::vector<Dwell> dwells_of(double hours, const Next& next) {
  std::vector<Dwell> dwells{{1200.0, 0.0}};
  double left_s = hours * kHour_s - 1200.0;
  while (left_s > 0.0) {
    Dwell dwell = next();
    dwell.duration_s = std::min(left_s, 60.0 * std::round(dwell.duration_s / 60.0));
    if (left_s - dwell.duration_s < kShortest_s) dwell.duration_s = left_s;
    dwells.push_back(dwell);
    left_s -= dwell.duration_s;
  }
  return dwells;
}

// Log-uniform dwells, each at a different speed from the last, one in four at rest. They are the same for all machines,
// so that a plan is reproducible.
std::vector<Dwell> random_speeds(double hours, double max_rpm) {
  std::mt19937_64 random = simulation::stream_of(1, simulation::Stream::signal, 21);
  double last_rpm = 0.0;
  return dwells_of(hours, [&] {
    const double dwell_s = kShortest_s * std::pow(kLongest_s / kShortest_s, simulation::uniform(random));
    double rpm = last_rpm;
    while (std::abs(rpm - last_rpm) < 0.15 * max_rpm) {
      const double level = simulation::uniform(random);
      rpm = simulation::uniform(random) < 0.25 ? 0.0 : rounded_rpm((0.2 + 0.8 * level) * max_rpm);
    }
    last_rpm = rpm;
    return Dwell{dwell_s, rpm};
  });
}

// As often as there is time for steps of half an hour, at least once.
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

// First short, then long.
std::vector<Dwell> stop_and_go(double hours, double max_rpm) {
  double next_s = kShortest_s;
  bool turns = false;
  return dwells_of(hours, [&] {
    turns = !turns;
    const double dwell_s = next_s;
    if (!turns) next_s = next_s * 1.6 > kLongest_s ? kShortest_s : next_s * 1.6;
    return Dwell{dwell_s, turns ? max_rpm : 0.0};
  });
}

std::vector<Dwell> dwells_of(SpeedProgram speeds, double hours, double max_rpm) {
  switch (speeds) {
    case SpeedProgram::random:
      return random_speeds(hours, max_rpm);
    case SpeedProgram::staircase:
      return staircase(hours, max_rpm);
    case SpeedProgram::stop_and_go:
      return stop_and_go(hours, max_rpm);
    case SpeedProgram::rest:
      break;
  }
  return {{hours * kHour_s, 0.0}};
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

std::vector<std::vector<ExpectedTest>> menu_of(const Series& data, const std::string& target,
                                               const TestPlanOptions& options) {
  const Column* speed = first_speed(data);
  const double data_rpm = speed == nullptr ? 0.0 : largest_of(speed->values), reading_s = reading_s_of(data, target);
  const double max_rpm = speed != nullptr && options.max_rpm > 0.0 ? options.max_rpm : data_rpm;
  std::vector<double> lengths_h;
  for (const double hours : kHours) {
    if (hours < options.most_hours - 0.5) lengths_h.push_back(hours);
  }
  lengths_h.push_back(options.most_hours);
  std::vector<SpeedProgram> kinds{SpeedProgram::rest};
  if (max_rpm > 0.0) kinds = {SpeedProgram::random, SpeedProgram::staircase, SpeedProgram::stop_and_go};
  const std::size_t unmoved = kinds.size();
  if (options.can_room || options.can_coolant || (options.can_load && max_rpm > 0.0)) kinds.push_back(kinds.front());
  std::vector<std::vector<ExpectedTest>> menu(kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    for (const double hours : lengths_h) {
      std::vector<Dwell> dwells = dwells_of(kinds[k], hours, max_rpm);
      const bool moved = k >= unmoved;
      if (moved && options.can_room) move(dwells, hours / 4.0, &Dwell::room_K, kRoomStep_K, 0.0);
      if (moved && options.can_coolant) move(dwells, hours / 6.0, &Dwell::coolant_K, kCoolantStep_K, 0.0);
      if (moved && options.can_load) move(dwells, hours / 10.0, &Dwell::load, kLoadStep, 1.0);
      menu[k].push_back({kinds[k], max_rpm, hours, {dwells, std::max(reading_s, hours * kHour_s / kMostReadings)}});
    }
  }
  return menu;
}

}  // namespace ballbar
