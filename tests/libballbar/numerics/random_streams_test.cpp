// Noise of the virtual machine, and that each stream of it is independent and fixed.
#include "numerics/random_streams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "ballbar/lab/simulation/simulate.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

TEST(SimulateNoise, many_normal_numbers_are_independent) {
  std::mt19937_64 random = simulation::stream_of(1, simulation::Stream::signal, 9);
  std::vector<double> values(100'001);
  for (double& value : values) value = simulation::normal(random);
  const double n = static_cast<double>(values.size());
  double mean = 0.0, square = 0.0, fourth = 0.0, neighbours = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    mean += values[i] / n;
    square += std::pow(values[i], 2) / n;
    fourth += std::pow(values[i], 4) / n;
    if (i > 0) neighbours += values[i] * values[i - 1] / n;
  }
  // Four standard errors: 1, sqrt 2, sqrt 96 and 1 over sqrt n.
  EXPECT_NEAR(mean, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(square, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth, 3.0, 4.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(neighbours, 0.0, 4.0 / std::sqrt(n));
}

VirtualMachine noisy(std::uint64_t seed) {
  VirtualMachine machine;
  machine.method = Method::circles;
  machine.truth = {TruePosition{}};
  machine.test_s = {0.0};
  machine.bar.resolution_um = 0.0;
  machine.circle = {0.0, 360.0, 200'000};
  machine.seed = seed;
  return machine;
}

std::vector<double> ccw_mm(const VirtualMachine& machine) {
  const SimulatedSession simulated = simulate(machine);
  return simulated.session.tests.at(0).circles.at(0).length_mm;
}

// Noise of the CCW recording: its true lengths are all 100 mm.
std::vector<double> noise_um(const VirtualMachine& machine) {
  std::vector<double> noise = ccw_mm(machine);
  for (double& value : noise) value = um_from_mm(value - 100.0);
  return noise;
}

double mean_product(const std::vector<double>& values, std::size_t lag) {
  const auto skipped = static_cast<std::ptrdiff_t>(lag);
  return std::inner_product(values.begin() + skipped, values.end(), values.begin(), 0.0) /
         static_cast<double>(values.size() - lag);
}

// White: variance 0.04 um^2 +- 0.04 sqrt(2/n), lag 1 0 +- 0.04/sqrt(n); bounds are 5 of these sigma.
TEST(SimulateNoise, White) {
  const std::vector<double> noise = noise_um(noisy(11));
  const double root_n = std::sqrt(static_cast<double>(noise.size()));
  EXPECT_NEAR(mean_product(noise, 0), 0.04, 5.0 * 0.04 * std::sqrt(2.0) / root_n);
  EXPECT_NEAR(mean_product(noise, 1), 0.0, 5.0 * 0.04 / root_n);
}

// AR(1), phi = 0.8: the same variance, its estimate sqrt((1 + phi^2)/(1 - phi^2)) = 2.13 times as uncertain
// (Bartlett); lag 1 is phi times it, to no more than that uncertainty, lag 3 phi^3.
TEST(SimulateNoise, Autocorrelated) {
  VirtualMachine machine = noisy(12);
  machine.bar.autocorrelation = 0.8;
  const std::vector<double> noise = noise_um(machine);
  const double bound = 5.0 * 2.14 * 0.04 * std::sqrt(2.0) / std::sqrt(static_cast<double>(noise.size()));
  EXPECT_NEAR(mean_product(noise, 0), 0.04, bound);
  EXPECT_NEAR(mean_product(noise, 1), 0.8 * 0.04, bound);
  EXPECT_NEAR(mean_product(noise, 3), 0.512 * 0.04, bound);
}

// Readings are multiples of 0.1 um, written as the nearest double to that decimal.
TEST(SimulateNoise, Resolution) {
  VirtualMachine machine = noisy(13);
  machine.bar.resolution_um = 0.1;
  for (const double length_mm : ccw_mm(machine)) {
    ASSERT_EQ(length_mm, std::round(length_mm * 1e4) / 1e4);
  }
}

// 1 % of 200 000 readings: 2000 +- sqrt(1980) = 44.5, within 5 of these; 50 um off against 0.2 um of noise.
TEST(SimulateNoise, Outliers) {
  VirtualMachine machine = noisy(14);
  machine.bar.outlier_share = 0.01;
  machine.bar.outlier_um = -50.0;
  const std::vector<double> noise = noise_um(machine);
  const auto outliers = std::count_if(noise.begin(), noise.end(), [](double value_um) { return value_um < -40.0; });
  EXPECT_NEAR(static_cast<double>(outliers), 2000.0, 5.0 * 44.5);
}

VirtualMachine with_everything() {
  VirtualMachine machine;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 4.0, 30.0, 5.0, 0.0}};
  machine.test_s = {0.0, 600.0};
  machine.signals = {{"T_air_degC", Role::ambient, {0.0}, {20.0}, 0.05, 0.01}};
  machine.five_probe.present = true;
  return machine;
}

TEST(SimulateStreams, SameSeedSameSession) {
  const SimulatedSession one = simulate(with_everything()), two = simulate(with_everything());
  EXPECT_EQ(one.session.tests[1].c_arc->length_mm, two.session.tests[1].c_arc->length_mm);
  EXPECT_EQ(one.session.tests[1].a_arc->length_mm, two.session.tests[1].a_arc->length_mm);
  EXPECT_EQ(one.signals.columns[0].values, two.signals.columns[0].values);
  EXPECT_EQ(one.five_probe.columns[0].values, two.five_probe.columns[0].values);
  VirtualMachine other = with_everything();
  other.seed = 2;
  EXPECT_NE(simulate(other).session.tests[1].c_arc->length_mm, one.session.tests[1].c_arc->length_mm);
}

// A test before, between or after, and another signal, leave all other readings as they were.
TEST(SimulateStreams, AddingChangesNothingElse) {
  const SimulatedSession before = simulate(with_everything());
  VirtualMachine more = with_everything();
  more.test_s = {0.0, 300.0, 600.0, 900.0};
  more.signals.insert(more.signals.begin(), {"speed_rpm", Role::speed, {0.0}, {14000.0}, 1.0, 1.0});
  const SimulatedSession after = simulate(more);
  EXPECT_EQ(after.session.tests[2].c_arc->length_mm, before.session.tests[1].c_arc->length_mm);
  EXPECT_EQ(after.session.tests[2].a_arc->length_mm, before.session.tests[1].a_arc->length_mm);
  for (std::size_t i = 0; i < before.signals.time_s.size(); ++i) {
    ASSERT_EQ(after.signals.columns[1].values[i], before.signals.columns[0].values[i]);
  }
}

// The first numbers of a stream are fixed by the standard (mt19937_64, seed_seq) and by Box and Muller: a change
// here changes every committed sample run.
TEST(SimulateStreams, FixedForEver) {
  VirtualMachine machine = noisy(1);
  machine.circle.readings = 2;
  machine.bar.resolution_um = 0.001;
  EXPECT_EQ(ccw_mm(machine), (std::vector<double>{99.9998, 99.999604}));
}

}  // namespace
}  // namespace ballbar
