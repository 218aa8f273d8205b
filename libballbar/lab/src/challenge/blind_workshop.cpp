#include <fmt/format.h>

#include <array>
#include <iterator>
#include <map>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "challenge/blind_parts.hpp"

namespace ballbar::blind {
namespace {

constexpr double kHour_s = 3600.0;
constexpr std::array kInterval_s{15.0, 20.0, 30.0, 45.0, 60.0, 75.0};
constexpr std::array kSometimes{"T_rear_degC",    "T_motor_degC", "T_housing_degC",
                                "T_coolant_degC", "T_head_degC",  "T_column_degC"};

double drawn_speed_rpm(Random& random) { return 500.0 * std::round(between(random, 4.0, 36.0)); }

// Rest, and stretches of 10 min to 4 h, shorter in a short record, at speeds that often come again.
void plan_speeds(DutyPlan& plan, bool loads, Random& random) {
  std::vector<double> speeds_rpm;
  for (std::size_t i = 0; i < 2 + index_below(random, 4); ++i) speeds_rpm.push_back(drawn_speed_rpm(random));
  const double longest_s = std::min(4.0 * kHour_s, plan.end_s / 4.0);
  double last_rpm = -1.0;
  for (double time_s = 0.0; time_s < plan.end_s;) {
    double speed_rpm = chance(random, 0.3) ? 0.0 : one_of(random, speeds_rpm);
    if (speed_rpm == last_rpm) speed_rpm = speed_rpm > 0.0 ? 0.0 : speeds_rpm.front();
    plan.time_s.push_back(time_s);
    plan.speed_rpm.push_back(speed_rpm);
    if (loads) {
      plan.load_W.push_back(speed_rpm > 0.0 && chance(random, 0.6) ? 100.0 * std::round(between(random, 5.0, 40.0))
                                                                   : 0.0);
    }
    last_rpm = speed_rpm;
    time_s += log_between(random, std::min(600.0, longest_s / 4.0), longest_s);
  }
}

// Load proportional to the speed of the only stretch.
void plan_one_speed(DutyPlan& plan, Random& random) {
  plan.time_s = {0.0, plan.end_s * between(random, 0.05, 0.2)};
  plan.speed_rpm = {0.0, drawn_speed_rpm(random)};
  plan.load_W = {0.0, 100.0 * std::round(between(random, 5.0, 40.0))};
}

Room drawn_room(Random& random) {
  const double mean_degC = between(random, 18.0, 25.0), day_K = between(random, 0.2, 2.0);
  return {mean_degC, day_K, between(random, 0.0, 2.0 * kPi)};
}

// Day and night, a wandering, and now and then a door or an air conditioner: steps of 10 min. `set_K`: so much warmer.
template <class SetAt>
void plan_room(DutyPlan& plan, const Room& room, SetAt set_K, Random& random) {
  double wandering_K = 0.0, step_K = 0.0;
  constexpr double kEach_s = 600.0;
  for (double time_s = 0.0; time_s <= plan.end_s + kEach_s; time_s += kEach_s) {
    plan.room_time_s.push_back(time_s);
    plan.room_degC.push_back(room.mean_degC +
                             room.day_K * std::sin(2.0 * kPi * time_s / (24.0 * kHour_s) + room.phase_rad) +
                             wandering_K + step_K + set_K(time_s));
    wandering_K = 0.98 * wandering_K + 0.08 * simulation::normal(random);
    if (chance(random, 0.02)) step_K = between(random, -1.5, 1.5);
  }
}

// Sensors, causes and what is logged of that plan.
void run_and_log(Workshop& workshop, std::uint64_t seed) {
  const ThermalRun run = run_of(workshop.spindle, workshop.plan, {}, workshop.clock);
  workshop.sensors = run.sensors;
  workshop.causes = run.truth;
  workshop.logged = measured_series(run, workshop.measurement, seed);
  std::erase_if(workshop.logged.columns, [](const Column& column) { return column.role == Role::measured; });
}

void log_room_constant(Workshop& workshop) {
  for (Column& column : workshop.logged.columns) {
    if (column.name != "T_room_degC") continue;
    std::fill(column.values.begin(), column.values.end(), workshop.plan.room_degC.front());
  }
}

// The mean load of the plan at that speed; in proportion between its speeds, and beyond the fastest.
double load_at_W(const DutyPlan& plan, double speed_rpm) {
  std::map<double, std::pair<double, double>> at{{0.0, {1.0, 0.0}}};  // speed: seconds, watt seconds
  for (std::size_t i = 0; i < plan.time_s.size(); ++i) {
    if (!(plan.speed_rpm[i] > 0.0)) continue;
    const double lasts_s = (i + 1 < plan.time_s.size() ? plan.time_s[i + 1] : plan.end_s) - plan.time_s[i];
    at[plan.speed_rpm[i]].first += lasts_s;
    at[plan.speed_rpm[i]].second += lasts_s * plan.load_W[i];
  }
  const auto load_W = [](const auto& entry) { return entry.second.second / entry.second.first; };
  const auto above = at.lower_bound(speed_rpm);
  if (above == at.begin()) return 0.0;
  if (above == at.end()) return at.size() < 2 ? 0.0 : load_W(*at.rbegin()) * speed_rpm / at.rbegin()->first;
  const auto below = std::prev(above);
  const double share = (speed_rpm - below->first) / (above->first - below->first);
  return load_W(*below) + share * (load_W(*above) - load_W(*below));
}

// What the schedule says, behind `before_s` of what the first run did; its first stretch is longer by `late_s`, the
// last one shorter.
DutyPlan duty_of(const Schedule& schedule, const DutyPlan& first, double before_s, double late_s) {
  DutyPlan plan;
  const bool has_load = !first.load_W.empty();
  const auto add = [&](double time_s, double speed_rpm, double load_W, double coolant_K) {
    plan.time_s.push_back(time_s);
    plan.speed_rpm.push_back(speed_rpm);
    if (has_load) plan.load_W.push_back(load_W);
    plan.coolant_K.push_back(coolant_K);
  };
  for (std::size_t i = 0; i < first.time_s.size() && first.time_s[i] - first.time_s.front() < before_s; ++i) {
    add(first.time_s[i] - first.time_s.front(), first.speed_rpm[i], has_load ? first.load_W[i] : 0.0, 0.0);
  }
  double time_s = before_s;
  for (const Dwell& dwell : schedule.dwells) {
    const double load_W = has_load ? dwell.load * load_at_W(first, dwell.speed_rpm) : 0.0;
    const double begin_s = time_s > before_s ? time_s + late_s : time_s;
    time_s += dwell.duration_s;
    if (dwell.duration_s > 0.0 && begin_s < before_s + duration_s(schedule)) {
      add(begin_s, dwell.speed_rpm, load_W, dwell.coolant_K);
    }
  }
  plan.end_s = time_s;
  return plan;
}

// Student's t with 4 degrees of freedom over its standard deviation, sqrt 2; or normal.
double innovation(const Scatter& scatter, Random& random) {
  const double w = simulation::normal(random);
  if (!scatter.heavy) return w;
  double squares = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double each = simulation::normal(random);
    squares += each * each;
  }
  return w / std::sqrt(squares / 4.0) / std::sqrt(2.0);
}

}  // namespace

Workshop workshop_of(Plan kind, Random& random) {
  Workshop workshop;
  workshop.kind = kind;
  ThermalClock& clock = workshop.clock;
  clock.interval_s = one_of(random, kInterval_s);
  clock.step_s = std::max(30.0, clock.interval_s);
  DutyPlan& plan = workshop.plan;
  plan.end_s = std::round(log_between(random, 4.0, 48.0) * kHour_s);
  if (kind == Plan::one_speed) {
    plan_one_speed(plan, random);
  } else {
    plan_speeds(plan, chance(random, 0.4), random);
  }
  if (kind == Plan::constant_room) {
    plan.room_time_s = {0.0};
    plan.room_degC = {std::round(between(random, 18.0, 25.0))};
  } else {
    workshop.room = drawn_room(random);
    plan_room(
        plan, workshop.room, [](double) { return 0.0; }, random);
  }

  SpindleMeasurement& measurement = workshop.measurement;
  for (const char* sensor : kSometimes) {
    if (chance(random, 0.35)) measurement.not_logged.emplace_back(sensor);
  }
  if (plan.load_W.empty()) measurement.not_logged.emplace_back("load_W");
  const std::uint64_t seed = random();
  workshop.spindle = varied({}, 0.2, seed);
  run_and_log(workshop, seed);
  if (kind == Plan::constant_room) log_room_constant(workshop);
  return workshop;
}

Day day_under(const Schedule& schedule, const DutyPlan& first, const ThermalClock& clock, Random& random) {
  Day day;
  day.clock.interval_s = schedule.reading_s > 0.0 ? schedule.reading_s : clock.interval_s;
  day.clock.step_s = std::clamp(day.clock.interval_s, 30.0, kInterval_s.back());
  if (!(duration_s(schedule) >= day.clock.interval_s)) {
    throw Error(fmt::format("schedule: expected at least as long as from reading to reading, {:g} s, found {:g} s.",
                            day.clock.interval_s, duration_s(schedule)));
  }
  if (schedule.starts_warm) {
    day.before_s = std::floor((first.end_s - first.time_s.front()) / day.clock.interval_s) * day.clock.interval_s;
  }
  day.plan = duty_of(schedule, first, day.before_s, between(random, 0.0, day.clock.interval_s));
  return day;
}

AnotherRun workshop_under(const Schedule& schedule, const Workshop& first, Random& random) {
  Day day = day_under(schedule, first.plan, first.clock, random);
  AnotherRun another{{}, day.before_s};
  Workshop& run = another.workshop;
  run.kind = first.kind;
  run.spindle = first.spindle;
  run.measurement = first.measurement;
  run.clock = std::move(day.clock);
  run.plan = std::move(day.plan);
  const auto set_K = [&](double time_s) {
    return time_s < another.before_s ? 0.0 : dwell_at(schedule, time_s - another.before_s).room_K;
  };
  if (first.kind == Plan::constant_room) {
    for (double time_s = 0.0; time_s <= run.plan.end_s + 600.0; time_s += 600.0) {
      run.plan.room_time_s.push_back(time_s);
      run.plan.room_degC.push_back(first.plan.room_degC.front() + set_K(time_s));
    }
  } else {
    run.room = first.room;
    run.room.phase_rad = between(random, 0.0, 2.0 * kPi);
    plan_room(run.plan, run.room, set_K, random);
  }
  run_and_log(run, random());
  const bool is_moved = std::any_of(schedule.dwells.begin(), schedule.dwells.end(),
                                    [](const Dwell& dwell) { return dwell.room_K != 0.0; });
  if (first.kind == Plan::constant_room && !is_moved) log_room_constant(run);
  return another;
}

Scatter drawn_scatter(Random& random) {
  Scatter scatter;
  scatter.sigma_um = log_between(random, 0.1, 0.5);
  scatter.phi = between(random, 0.5, 0.98);
  scatter.resolution_um = one_of(random, std::array{0.01, 0.02, 0.05, 0.1});
  scatter.heavy = chance(random, 0.25);
  return scatter;
}

// Rounding is a white noise with a standard deviation of resolution / sqrt 12.
Noise noise_model(const Scatter& scatter, double interval_s) {
  return {scatter.resolution_um / std::sqrt(12.0), scatter.sigma_um, -interval_s / std::log(scatter.phi), 0.0};
}

std::vector<double> noise_um(std::size_t n, const Scatter& scatter, Random& random) {
  std::vector<double> values;
  simulation::Ar1 memory(1.0, scatter.phi);
  double last = memory.next(random);
  for (std::size_t i = 0; i < n; ++i) {
    values.push_back(scatter.sigma_um * last);
    last = memory.next(innovation(scatter, random));
  }
  return values;
}

}  // namespace ballbar::blind
