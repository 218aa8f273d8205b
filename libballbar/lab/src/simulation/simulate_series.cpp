#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "numerics/random_streams.hpp"
#include "simulation/simulate_parts.hpp"

namespace ballbar::simulation {
namespace {

Column measured(std::string name) { return {std::move(name), Role::measured, {}}; }

// A probe's true reading, x, y or z at a plane of the bar, from the drift since the first test.
double probe_um(const VirtualFiveProbe& probe, std::size_t column, const TruePosition& drift) {
  const double tilt_b_mrad = probe.tilt_b_urad_per_um * drift.x_um / 1e3;  // um per mm
  const double tilt_a_mrad = probe.tilt_a_urad_per_um * drift.y_um / 1e3;
  const double from_ball_mm = (column % 2 == 0 ? 0.0 : probe.spacing_mm) - probe.ball_offset_mm;
  if (column < 2) return drift.x_um + tilt_b_mrad * from_ball_mm;
  if (column < 4) return drift.y_um - tilt_a_mrad * from_ball_mm;
  return drift.z_um;
}

TruePosition since(const TruePosition& first, const TruePosition& later) {
  return {later.time_s, later.x_um - first.x_um, later.y_um - first.y_um, later.z_um - first.z_um,
          later.along_bar_um - first.along_bar_um};
}

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

double interpolated(const std::vector<double>& time_s, const std::vector<double>& value, double at_s) {
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), at_s);
  if (after == time_s.begin()) return value.front();
  if (after == time_s.end()) return value.back();
  const auto i = static_cast<std::size_t>(after - time_s.begin());
  const double share = (at_s - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
  return value[i - 1] + share * (value[i] - value[i - 1]);
}

TruePosition truth_at(const VirtualMachine& machine, double at_s) {
  const std::vector<TruePosition>& truth = machine.truth;
  const auto later = [](double time_s, const TruePosition& point) { return time_s < point.time_s; };
  const auto after = std::upper_bound(truth.begin(), truth.end(), at_s, later);
  if (after == truth.begin() || after == truth.end()) {
    TruePosition held = after == truth.begin() ? truth.front() : truth.back();
    held.time_s = at_s;
    return held;
  }
  const TruePosition& before = *(after - 1);
  const double share = (at_s - before.time_s) / (after->time_s - before.time_s);
  const auto at = [&](double TruePosition::*component) {
    return before.*component + share * ((*after).*component - before.*component);
  };
  return {at_s, at(&TruePosition::x_um), at(&TruePosition::y_um), at(&TruePosition::z_um),
          at(&TruePosition::along_bar_um)};
}

std::vector<double> clock_s(double first_s, double last_s, double interval_s) {
  std::vector<double> time_s;
  const auto rows = static_cast<std::size_t>(std::ceil((last_s - first_s) / interval_s - 1e-9)) + 1;
  for (std::size_t i = 0; i < rows; ++i) time_s.push_back(first_s + static_cast<double>(i) * interval_s);
  return time_s;
}

Series signals_of(const VirtualMachine& machine) {
  Series series;
  if (machine.signals.empty()) return series;
  series.time_s = clock_s(machine.test_s.front(), machine.test_s.back(), machine.interval_s);
  for (const VirtualSignal& signal : machine.signals) {
    std::mt19937_64 random = stream_of(machine.seed, Stream::signal, key_of(signal.name));
    Column column{signal.name, signal.role, {}};
    for (const double at_s : series.time_s) {
      const double value = interpolated(signal.time_s, signal.value, at_s);
      column.values.push_back(rounded(value + signal.noise * normal(random), signal.resolution));
    }
    series.columns.push_back(std::move(column));
  }
  return series;
}

Series five_probe_of(const VirtualMachine& machine) {
  Series series;
  const VirtualFiveProbe& probe = machine.five_probe;
  if (!probe.present) return series;
  series.five_probe = FiveProbe{};
  series.five_probe->spacing_mm = probe.spacing_mm;
  if (probe.resolution_um > 0.0) series.five_probe->resolution_um = probe.resolution_um;
  series.time_s = clock_s(machine.test_s.front(), machine.test_s.back(), probe.interval_s);
  const TruePosition first = truth_at(machine, machine.test_s.front());
  for (const char* name : {"X1_um", "X2_um", "Y1_um", "Y2_um", "Z_um"}) {
    std::mt19937_64 random = stream_of(machine.seed, Stream::probe, key_of(std::string_view(name)));
    Column column = measured(name);
    for (const double at_s : series.time_s) {
      const double true_um = probe_um(probe, series.columns.size(), since(first, truth_at(machine, at_s)));
      column.values.push_back(rounded(true_um + probe.noise_um * normal(random), probe.resolution_um));
    }
    series.columns.push_back(std::move(column));
  }
  return series;
}

Series truth_of(const VirtualMachine& machine) {
  Series series;
  series.time_s = machine.test_s;
  if (machine.method == Method::spindle_rotation) {
    series.columns = {measured("radial_um"), measured("axial_um"), measured("shift_a_um"), measured("shift_b_um"),
                      measured("radius_change_um")};
  } else {
    series.columns = {measured("x_um"), measured("y_um"), measured("z_um")};
  }
  const TruePosition first = truth_at(machine, machine.test_s.front());
  for (const double at_s : machine.test_s) {
    const TruePosition drift = since(first, truth_at(machine, at_s));
    const std::vector<double> row = machine.method == Method::spindle_rotation
                                        ? std::vector<double>{std::hypot(drift.x_um, drift.y_um), drift.z_um,
                                                              drift.x_um, drift.y_um, drift.along_bar_um}
                                        : std::vector<double>{drift.x_um, drift.y_um, drift.z_um};
    for (std::size_t i = 0; i < row.size(); ++i) series.columns[i].values.push_back(row[i]);
  }
  return series;
}

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
