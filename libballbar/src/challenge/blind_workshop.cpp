#include <array>

#include "ballbar/simulation/virtual_spindle.hpp"
#include "ballbar/spindle/finite_volume_spindle.hpp"
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

// Day and night, a wandering, and now and then a door or an air conditioner: steps of 10 min.
void plan_room(DutyPlan& plan, Random& random) {
  const double mean_degC = between(random, 18.0, 25.0), day_K = between(random, 0.2, 2.0);
  const double phase_rad = between(random, 0.0, 2.0 * kPi);
  double wandering_K = 0.0, step_K = 0.0;
  constexpr double kEach_s = 600.0;
  for (double time_s = 0.0; time_s <= plan.end_s + kEach_s; time_s += kEach_s) {
    plan.room_time_s.push_back(time_s);
    plan.room_degC.push_back(mean_degC + day_K * std::sin(2.0 * kPi * time_s / (24.0 * kHour_s) + phase_rad) +
                             wandering_K + step_K);
    wandering_K = 0.98 * wandering_K + 0.08 * simulation::normal(random);
    if (chance(random, 0.02)) step_K = between(random, -1.5, 1.5);
  }
}

}  // namespace

Workshop workshop_of(Plan kind, Random& random) {
  ThermalClock clock;
  clock.interval_s = one_of(random, kInterval_s);
  clock.step_s = std::max(30.0, clock.interval_s);
  DutyPlan plan;
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
    plan_room(plan, random);
  }

  SpindleMeasurement measurement;
  for (const char* sensor : kSometimes) {
    if (chance(random, 0.35)) measurement.not_logged.emplace_back(sensor);
  }
  if (plan.load_W.empty()) measurement.not_logged.emplace_back("load_W");
  const std::uint64_t seed = random();
  const ThermalRun run = run_of(varied({}, 0.2, seed), plan, {}, clock);
  Workshop workshop{run.sensors, run.truth, measured_series(run, measurement, seed)};
  std::erase_if(workshop.logged.columns, [](const Column& column) { return column.role == Role::measured; });
  if (kind == Plan::constant_room) {
    for (Column& column : workshop.logged.columns) {
      if (column.name == "T_room_degC") std::fill(column.values.begin(), column.values.end(), plan.room_degC.front());
    }
  }
  return workshop;
}

}  // namespace ballbar::blind
