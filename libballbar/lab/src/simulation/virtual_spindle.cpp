#include "ballbar/lab/simulation/virtual_spindle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "ballbar/error.hpp"
#include "numerics/random_streams.hpp"
#include "simulation/simulate_parts.hpp"

namespace ballbar {
namespace {

struct Measurement {
  std::string_view name;
  double value;
};

void expect_measurable(std::initializer_list<Measurement> numbers) {
  for (const auto& [name, value] : numbers) {
    if (std::isfinite(value) && value >= 0.0) continue;
    throw Error(fmt::format("spindle: expected a number not below 0 for {}, found {}.", name, value));
  }
}

// Never the zero with a minus, which a file would show.
double reading(double value, double resolution) { return simulation::rounded(value, resolution) + 0.0; }

// Student's t with f degrees of freedom, sqrt(f - 2) / sqrt(f) of it, so that the standard deviation is 1:
// t = w_0 / sqrt((w_1^2 + ... + w_f^2) / f), w normal.
double heavy_tailed(std::mt19937_64& random, double freedom) {
  const double w = simulation::normal(random);
  if (freedom == 0.0) return w;
  double squares = 0.0;
  for (double i = 0.0; i < freedom; ++i) {
    const double each = simulation::normal(random);
    squares += each * each;
  }
  return w / std::sqrt(squares / freedom) * std::sqrt((freedom - 2.0) / freedom);
}

Column measured_position(const ThermalRun& run, const Column& truth, const SpindleMeasurement& measurement,
                         std::uint64_t seed) {
  using simulation::Stream;
  const std::uint64_t key = simulation::key_of(std::string_view(truth.name));
  std::mt19937_64 independent = simulation::stream_of(seed, Stream::spindle_noise, key);
  std::mt19937_64 remembered = simulation::stream_of(seed, Stream::spindle_memory, key);
  const double interval_s = run.truth.time_s.size() < 2 ? 0.0 : run.truth.time_s[1] - run.truth.time_s[0];
  simulation::Ar1 memory_um(measurement.memory_um, std::exp(-interval_s / measurement.memory_s));
  Column column{truth.name, Role::measured, {}};
  for (const double true_um : truth.values) {
    const double noise_um = measurement.noise_um * heavy_tailed(independent, measurement.tail_freedom);
    column.values.push_back(reading(true_um + noise_um + memory_um.next(remembered), measurement.resolution_um));
  }
  return column;
}

Column measured_sensor(const Column& sensor, const SpindleMeasurement& measurement, std::uint64_t seed) {
  if (unit_of(sensor.name) != "degC") return sensor;
  std::mt19937_64 random =
      simulation::stream_of(seed, simulation::Stream::signal, simulation::key_of(std::string_view(sensor.name)));
  Column column{sensor.name, sensor.role, {}};
  for (const double true_degC : sensor.values) {
    column.values.push_back(reading(true_degC + measurement.temperature_noise_K * simulation::normal(random),
                                    measurement.temperature_resolution_K));
  }
  return column;
}

constexpr std::array kVaried = {&FiniteVolumeSpindle::f0,
                                &FiniteVolumeSpindle::bearing_load_N,
                                &FiniteVolumeSpindle::inner_ring_W_per_K,
                                &FiniteVolumeSpindle::outer_ring_W_per_K,
                                &FiniteVolumeSpindle::motor_loss_W,
                                &FiniteVolumeSpindle::motor_windage_W,
                                &FiniteVolumeSpindle::shaft_turning_W_per_m2_K,
                                &FiniteVolumeSpindle::gap_turning_W_per_m2_K,
                                &FiniteVolumeSpindle::jacket_W_per_K,
                                &FiniteVolumeSpindle::flow_W_per_K,
                                &FiniteVolumeSpindle::tank_kg,
                                &FiniteVolumeSpindle::chiller_W,
                                &FiniteVolumeSpindle::flange_W_per_K,
                                &FiniteVolumeSpindle::head_kg,
                                &FiniteVolumeSpindle::column_kg,
                                &FiniteVolumeSpindle::head_column_W_per_K,
                                &FiniteVolumeSpindle::column_front_back_W_per_K,
                                &FiniteVolumeSpindle::head_room_W_per_K,
                                &FiniteVolumeSpindle::column_room_W_per_K};
constexpr std::array kVariedShares = {&FiniteVolumeSpindle::stator_to_plus_x, &FiniteVolumeSpindle::coolant_to_plus_x,
                                      &FiniteVolumeSpindle::flange_to_minus_y};

}  // namespace

FiniteVolumeSpindle varied(const FiniteVolumeSpindle& spindle, double spread, std::uint64_t seed) {
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::spindle_variety, 0);
  FiniteVolumeSpindle result = spindle;
  for (double FiniteVolumeSpindle::*const member : kVaried) {
    result.*member *= std::exp(spread * simulation::normal(random));
  }
  for (double FiniteVolumeSpindle::*const member : kVariedShares) {
    result.*member = std::clamp(result.*member * std::exp(spread * simulation::normal(random)), -1.0, 1.0);
  }
  return result;
}

namespace simulation {

void check(const SpindleMeasurement& measurement, const Series& sensors) {
  expect_measurable({{"noise_um", measurement.noise_um},
                     {"memory_um", measurement.memory_um},
                     {"resolution_um", measurement.resolution_um},
                     {"temperature_noise_K", measurement.temperature_noise_K},
                     {"temperature_resolution_K", measurement.temperature_resolution_K}});
  if (!(std::isfinite(measurement.memory_s) && measurement.memory_s > 0.0)) {
    throw Error(fmt::format("spindle: expected a number above 0 for memory_s, found {}.", measurement.memory_s));
  }
  constexpr double kMostFreedom = 100.0;
  const double freedom = measurement.tail_freedom;
  if (freedom != 0.0 && !(freedom > 2.0 && freedom <= kMostFreedom && freedom == std::floor(freedom))) {
    throw Error(fmt::format("spindle: expected 0 or a whole number from 3 to {} for tail_freedom, found {}.",
                            kMostFreedom, freedom));
  }
  for (const std::string& name : measurement.not_logged) {
    if (find_column(sensors, name)) continue;
    std::vector<std::string_view> names;
    for (const Column& column : sensors.columns) names.push_back(column.name);
    throw Error(fmt::format("spindle: expected one of {} in not_logged, found \"{}\".", fmt::join(names, ", "), name));
  }
}

bool is_logged(const SpindleMeasurement& measurement, const std::string& name) {
  return std::find(measurement.not_logged.begin(), measurement.not_logged.end(), name) == measurement.not_logged.end();
}

}  // namespace simulation

Series measured_series(const ThermalRun& run, const SpindleMeasurement& measurement, std::uint64_t seed) {
  simulation::check(measurement, run.sensors);
  Series series;
  series.time_s = run.sensors.time_s;
  for (const Column& sensor : run.sensors.columns) {
    if (simulation::is_logged(measurement, sensor.name)) {
      series.columns.push_back(measured_sensor(sensor, measurement, seed));
    }
  }
  for (const char* name : {"x_um", "y_um", "z_um"}) {
    series.columns.push_back(measured_position(run, *find_column(run.truth, name), measurement, seed));
  }
  return series;
}

}  // namespace ballbar
