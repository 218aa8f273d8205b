#include <array>

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
