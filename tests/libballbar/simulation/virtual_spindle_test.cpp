#include "ballbar/lab/simulation/virtual_spindle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "ballbar/error.hpp"
#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar {
namespace {

// 100 min at 10 000 rpm, a row every 15 s.
const ThermalRun& run() {
  static const ThermalRun kRun = run_of({}, {.time_s = {0.0}, .speed_rpm = {10000.0}, .end_s = 6000.0});
  return kRun;
}

std::vector<double> noise_um(const SpindleMeasurement& measurement, std::uint64_t seed = 7) {
  const Series measured = measured_series(run(), measurement, seed);
  std::vector<double> noise = find_column(measured, "z_um")->values;
  for (std::size_t row = 0; row < noise.size(); ++row) noise[row] -= find_column(run().truth, "z_um")->values[row];
  return noise;
}

double mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

SpindleMeasurement quiet() {
  return {.noise_um = 0.0, .resolution_um = 0.0, .temperature_noise_K = 0.0, .temperature_resolution_K = 0.0};
}

TEST(VirtualSpindle, WithoutNoiseItIsTheTruth) {
  const Series measured = measured_series(run(), quiet(), 1);
  EXPECT_EQ(measured.time_s, run().truth.time_s);
  EXPECT_EQ(find_column(measured, "x_um")->values, find_column(run().truth, "x_um")->values);
  EXPECT_EQ(find_column(measured, "z_um")->role, Role::measured);
  EXPECT_EQ(find_column(measured, "T_head_degC")->values, find_column(run().sensors, "T_head_degC")->values);
}

// 401 rows: the standard deviation of a standard deviation is 3.5 %.
TEST(VirtualSpindle, NoiseIsAsStated) {
  SpindleMeasurement measurement = quiet();
  measurement.noise_um = 0.4;
  EXPECT_NEAR(std::sqrt(mean_square(noise_um(measurement))), 0.4, 0.05);
  measurement.tail_freedom = 5.0;
  EXPECT_NEAR(std::sqrt(mean_square(noise_um(measurement))), 0.4, 0.12);  // kurtosis 9
}

// Student's t with 3 degrees of freedom has 1.4 % beyond 3 standard deviations, the normal distribution 0.27 %.
TEST(VirtualSpindle, TailsAreHeavy) {
  SpindleMeasurement measurement = quiet();
  measurement.noise_um = 1.0;
  const auto beyond = [&](double freedom) {
    measurement.tail_freedom = freedom;
    int count = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      for (const double noise : noise_um(measurement, seed)) count += std::abs(noise) > 3.0 ? 1 : 0;
    }
    return static_cast<double>(count) / (20.0 * 401.0);
  };
  EXPECT_NEAR(beyond(0.0), 0.0027, 0.002);
  EXPECT_NEAR(beyond(3.0), 0.0138, 0.004);
}

// Correlation exp(-15 / 600) = 0.975 of neighbours: the differences have 2 (1 - 0.975) q^2.
TEST(VirtualSpindle, NoiseRemembers) {
  SpindleMeasurement measurement = quiet();
  measurement.memory_um = 2.0;
  const std::vector<double> noise = noise_um(measurement);
  std::vector<double> steps;
  for (std::size_t row = 1; row < noise.size(); ++row) steps.push_back(noise[row] - noise[row - 1]);
  EXPECT_NEAR(mean_square(steps), 2.0 * (1.0 - std::exp(-0.025)) * 4.0, 0.03);
}

TEST(VirtualSpindle, ReadingsAreRounded) {
  const Series measured = measured_series(run(), {.resolution_um = 0.05, .temperature_resolution_K = 0.1}, 3);
  for (const double z_um : find_column(measured, "z_um")->values) {
    ASSERT_NEAR(z_um / 0.05, std::round(z_um / 0.05), 1e-9);
  }
  for (const double T_degC : find_column(measured, "T_front_degC")->values) {
    ASSERT_NEAR(T_degC / 0.1, std::round(T_degC / 0.1), 1e-9);
  }
}

TEST(VirtualSpindle, SeedsAndColumnsAreIndependent) {
  EXPECT_EQ(noise_um({}, 5), noise_um({}, 5));
  EXPECT_NE(noise_um({}, 5), noise_um({}, 6));
  const Series all = measured_series(run(), {}, 5);
  const Series some = measured_series(run(), {.not_logged = {"T_room_degC", "load_W"}}, 5);
  EXPECT_EQ(some.columns.size() + 2, all.columns.size());
  EXPECT_EQ(find_column(some, "T_room_degC"), nullptr);
  EXPECT_EQ(find_column(some, "T_front_degC")->values, find_column(all, "T_front_degC")->values);
  EXPECT_EQ(find_column(some, "y_um")->values, find_column(all, "y_um")->values);
}

std::string complaint(const SpindleMeasurement& measurement) {
  try {
    measured_series(run(), measurement, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(VirtualSpindle, RefusesMeasurementsThatMakeNoSense) {
  EXPECT_EQ(complaint({.noise_um = -0.1}), "spindle: expected a number not below 0 for noise_um, found -0.1.");
  EXPECT_EQ(complaint({.tail_freedom = 2.0}),
            "spindle: expected 0 or a whole number from 3 to 100 for tail_freedom, found 2.");
  EXPECT_EQ(complaint({.memory_s = 0.0}), "spindle: expected a number above 0 for memory_s, found 0.");
  EXPECT_EQ(complaint({.not_logged = {"T_oil_degC"}}),
            "spindle: expected one of speed_rpm, load_W, T_front_degC, T_rear_degC, T_motor_degC, T_housing_degC, "
            "T_coolant_degC, T_head_degC, T_column_degC, T_room_degC in not_logged, found \"T_oil_degC\".");
}

TEST(VirtualSpindle, VariesFromSpindleToSpindle) {
  const FiniteVolumeSpindle one = varied({}, 0.2, 1);
  EXPECT_EQ(one.f0, varied({}, 0.2, 1).f0);
  EXPECT_NE(one.f0, varied({}, 0.2, 2).f0);
  EXPECT_EQ(one.length_mm, FiniteVolumeSpindle{}.length_mm);
  EXPECT_EQ(varied({}, 0.0, 1).jacket_W_per_K, FiniteVolumeSpindle{}.jacket_W_per_K);
  // 400 seeds: the mean of ln has a sigma of 0.01, its standard deviation one of 0.007.
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const double ln = std::log(varied({}, 0.2, seed).head_kg / FiniteVolumeSpindle{}.head_kg);
    sum += ln;
    squares += ln * ln;
  }
  EXPECT_NEAR(sum / 400.0, 0.0, 0.04);
  EXPECT_NEAR(std::sqrt(squares / 400.0), 0.2, 0.03);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ThermalRun other = run_of(varied({}, 0.3, seed), {.time_s = {0.0}, .speed_rpm = {15000.0}, .end_s = 3600.0});
    EXPECT_GT(find_column(other.truth, "z_um")->values.back(), 10.0) << seed;
  }
}

VirtualMachine machine(Method method) {
  VirtualMachine result;
  result.name = "m.toml";
  result.method = method;
  result.test_s = {0.0, 1800.0, 5400.0};
  result.bar.noise_um = 0.0;
  result.bar.resolution_um = 0.0;
  result.spindle = VirtualSpindle{};
  result.spindle->plan = {.time_s = {0.0}, .speed_rpm = {10000.0}, .end_s = 6000.0};
  result.spindle->measurement = quiet();
  return result;
}

double change_um(const Series& series, const char* name, std::size_t row) {
  return find_column(series, name)->values[row] - find_column(series, name)->values[0];
}

// 1800 s and 5400 s are rows 120 and 360 of the run; the machine's Z points up, away from the table.
TEST(VirtualSpindle, MovesTheBallOfTwoArcs) {
  const SimulatedSession simulated = simulate(machine(Method::two_arcs));
  EXPECT_NEAR(find_column(simulated.truth, "z_um")->values[1], -change_um(run().truth, "z_um", 120), 1e-9);
  EXPECT_NEAR(find_column(simulated.truth, "y_um")->values[2], change_um(run().truth, "y_um", 360), 1e-9);
  EXPECT_NEAR(find_column(simulated.truth, "z_shaft_um")->values[2], -change_um(run().truth, "z_shaft_um", 360), 1e-9);
  // The fit finds it: with no noise to the nm, the sweep being short of time.
  const DriftSeries drift = drift_of(simulated.session);
  EXPECT_NEAR(drift.points[2].z->value_um, -change_um(run().truth, "z_um", 360), 1e-3);
  EXPECT_NEAR(drift.points[2].x->value_um, change_um(run().truth, "x_um", 360), 1e-3);
}

TEST(VirtualSpindle, SensorsBecomeSignals) {
  VirtualMachine with_sensors = machine(Method::circles);
  with_sensors.spindle->measurement.not_logged = {"T_motor_degC"};
  with_sensors.interval_s = 15.0;
  const SimulatedSession simulated = simulate(with_sensors);
  ASSERT_NE(find_column(simulated.signals, "T_front_degC"), nullptr);
  EXPECT_EQ(find_column(simulated.signals, "T_motor_degC"), nullptr);
  EXPECT_EQ(find_column(simulated.signals, "T_front_degC")->role, Role::bearing);
  EXPECT_NEAR(find_column(simulated.signals, "T_front_degC")->values[120],
              find_column(run().sensors, "T_front_degC")->values[120], 1e-9);
}

TEST(VirtualSpindle, RotationShowsElongationAndRadiusChange) {
  const Series truth = simulate(machine(Method::spindle_rotation)).truth;
  EXPECT_NEAR(find_column(truth, "axial_um")->values[2], change_um(run().truth, "z_um", 360), 1e-9);
  EXPECT_NEAR(find_column(truth, "radius_change_um")->values[2], -change_um(run().truth, "x_um", 360), 1e-9);
  EXPECT_EQ(find_column(truth, "radial_um")->values[2], 0.0);
}

TEST(VirtualSpindle, AloneItIsASeries) {
  VirtualMachine alone = machine(Method::two_arcs);
  alone.series = true;
  const SimulatedSession simulated = simulate(alone);
  EXPECT_TRUE(simulated.session.tests.empty());
  EXPECT_EQ(find_column(simulated.series, "z_um")->values, find_column(run().truth, "z_um")->values);
  EXPECT_EQ(simulated.truth.columns.size(), run().truth.columns.size());
}

std::string complaint(const VirtualMachine& machine) {
  try {
    simulate(machine);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(VirtualSpindle, RefusesContradictions) {
  VirtualMachine twice = machine(Method::two_arcs);
  twice.truth = {TruePosition{}};
  EXPECT_EQ(complaint(twice), "m.toml: expected the truth from the spindle alone, found 1 stated points as well.");
  VirtualMachine late = machine(Method::two_arcs);
  late.test_s = {0.0, 9000.0};
  EXPECT_EQ(complaint(late), "m.toml: expected tests within the truth, 0 to 100 min, found one at 150 min.");
  VirtualMachine none = machine(Method::two_arcs);
  none.spindle.reset();
  none.series = true;
  EXPECT_EQ(complaint(none), "m.toml: expected a spindle, which method series is measured on, found none.");
}

}  // namespace
}  // namespace ballbar
