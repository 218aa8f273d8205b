#include "made.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/lab/simulation/virtual_spindle.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar::predictions {
namespace {

constexpr double kHour_s = 3600.0, kRow_s = 60.0;

using Random = std::mt19937_64;

double between(Random& random, double low, double high) { return low + (high - low) * simulation::uniform(random); }

// At rest for a quarter of an hour, then steps of 10 min to an hour, a fifth of them at rest.
DutyPlan plan_of(double hours, Random& random) {
  DutyPlan plan;
  plan.end_s = hours * kHour_s;
  plan.time_s = {0.0};
  plan.speed_rpm = {0.0};
  for (double time_s = 900.0; time_s < plan.end_s; time_s += kRow_s * std::round(between(random, 10.0, 60.0))) {
    plan.time_s.push_back(time_s);
    plan.speed_rpm.push_back(between(random, 0.0, 1.0) < 0.2 ? 0.0 : 500.0 * std::round(between(random, 4.0, 36.0)));
  }
  const double phase_rad = between(random, 0.0, 6.28), mean_degC = between(random, 19.0, 23.0);
  double wander_K = 0.0;
  for (double time_s = 0.0; time_s <= plan.end_s + 600.0; time_s += 600.0) {
    plan.room_time_s.push_back(time_s);
    plan.room_degC.push_back(mean_degC + std::sin(time_s / 13'750.0 + phase_rad) + wander_K);
    wander_K = 0.98 * wander_K + 0.08 * simulation::normal(random);
  }
  return plan;
}

Duty duty_of(const FiniteVolumeSpindle& spindle, double hours, const Made& of, Random& random) {
  const ThermalRun run = run_of(spindle, plan_of(hours, random), {}, {.interval_s = kRow_s, .step_s = 30.0});
  SpindleMeasurement measurement{.noise_um = 0.15,
                                 .memory_um = 0.4,
                                 .memory_s = 600.0,
                                 .resolution_um = 0.05,
                                 .temperature_noise_K = 0.01,
                                 .temperature_resolution_K = 0.0,
                                 .not_logged = {"load_W"}};
  if (of.rounded) measurement.temperature_resolution_K = 0.1;
  Duty duty{measured_series(run, measurement, random()), run.sensors};
  std::erase_if(duty.logged.columns,
                [&](const Column& column) { return column.role == Role::measured && column.name != of.target; });
  duty.truth.columns.insert(duty.truth.columns.end(), run.truth.columns.begin(), run.truth.columns.end());
  if (of.discrepant) {
    simulation::Ar1 discrepancy_um(1.0, std::exp(-kRow_s / 7200.0));
    for (double& value : duty.logged.columns.back().values) value += discrepancy_um.next(random);
  }
  return duty;
}

}  // namespace

Made made(std::uint64_t seed) {
  Random random(seed);
  constexpr const char* kTargets[] = {"x_um", "y_um", "z_um"};
  Made one;
  one.target = kTargets[seed / 2 % 3];
  one.rounded = seed % 2 == 0;
  one.discrepant = seed % 3 == 0;
  const FiniteVolumeSpindle spindle = varied({}, 0.2, random());
  one.training = duty_of(spindle, 8.0, one, random);
  one.unseen = duty_of(spindle, 6.0, one, random);
  return one;
}

std::vector<Series> runs_of(std::uint64_t seed, std::size_t count, double hours, const std::string& target) {
  Random random(seed);
  const FiniteVolumeSpindle spindle = varied({}, 0.2, random());
  std::vector<Series> runs;
  Made of;
  of.target = target;
  while (runs.size() < count) runs.push_back(duty_of(spindle, hours, of, random).logged);
  return runs;
}

Series random_walk(const Made& of, std::uint64_t seed) {
  Random random(~seed);
  Series series = of.training.logged;
  double at_um = 0.0;
  for (double& value : series.columns.back().values) {
    value = at_um;
    at_um += 0.3 * simulation::normal(random);
  }
  return series;
}

}  // namespace ballbar::predictions
