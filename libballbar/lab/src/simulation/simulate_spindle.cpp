#include "simulation/simulate_spindle.hpp"

#include <fmt/core.h>

#include "ballbar/error.hpp"
#include "simulation/simulate_parts.hpp"

namespace ballbar::simulation {
namespace {

// Elongation is towards the table, and Z of the machine points up; a spindle_rotation session states elongation.
double z_sign(Method method) { return method == Method::spindle_rotation ? 1.0 : -1.0; }

VirtualSignal signal_of(const Series& sensors, const Column& sensor, const SpindleMeasurement& measurement) {
  VirtualSignal signal{sensor.name, sensor.role, sensors.time_s, sensor.values};
  if (unit_of(sensor.name) == "degC") {
    signal.noise = measurement.temperature_noise_K;
    signal.resolution = measurement.temperature_resolution_K;
  }
  return signal;
}

}  // namespace

VirtualMachine moved_by(const VirtualMachine& machine, const ThermalRun& run) {
  if (!machine.truth.empty()) {
    throw Error(fmt::format("{}: expected the truth from the spindle alone, found {} stated points as well.",
                            machine.name, machine.truth.size()));
  }
  check(machine.spindle->measurement, run.sensors);
  VirtualMachine moved = machine;
  const std::vector<double>& x_um = find_column(run.truth, "x_um")->values;
  const std::vector<double>& y_um = find_column(run.truth, "y_um")->values;
  const std::vector<double>& z_um = find_column(run.truth, "z_um")->values;
  for (std::size_t row = 0; row < run.truth.time_s.size(); ++row) {
    TruePosition position{.time_s = run.truth.time_s[row], .z_um = z_sign(machine.method) * z_um[row]};
    if (machine.method == Method::spindle_rotation) {
      position.along_bar_um = -x_um[row];
    } else {
      position.x_um = x_um[row];
      position.y_um = y_um[row];
    }
    moved.truth.push_back(position);
  }
  for (const Column& sensor : run.sensors.columns) {
    if (!is_logged(machine.spindle->measurement, sensor.name)) continue;
    moved.signals.push_back(signal_of(run.sensors, sensor, machine.spindle->measurement));
  }
  return moved;
}

std::vector<Column> causes_at_tests(const VirtualMachine& machine, const ThermalRun& run) {
  std::vector<Column> causes;
  for (const Column& column : run.truth.columns) {
    if (column.name == "x_um" || column.name == "y_um" || column.name == "z_um") continue;
    const double sign = column.name.front() == 'z' ? z_sign(machine.method) : 1.0;
    const auto at = [&](double at_s) { return sign * interpolated(run.truth.time_s, column.values, at_s); };
    Column cause{column.name, Role::measured, {}};
    for (const double test_s : machine.test_s) cause.values.push_back(at(test_s) - at(machine.test_s.front()));
    causes.push_back(std::move(cause));
  }
  return causes;
}

SimulatedSession series_of(const VirtualMachine& machine) {
  if (!machine.spindle) {
    throw Error(fmt::format("{}: expected a spindle, which method series is measured on, found none.", machine.name));
  }
  const VirtualSpindle& spindle = *machine.spindle;
  const ThermalRun run = run_of(spindle.body, spindle.plan, spindle.mechanisms, spindle.clock);
  SimulatedSession simulated;
  simulated.session.title = machine.title;
  simulated.series = measured_series(run, spindle.measurement, machine.seed);
  simulated.truth = run.truth;
  simulated.profiles = run.profiles;
  return simulated;
}

}  // namespace ballbar::simulation
