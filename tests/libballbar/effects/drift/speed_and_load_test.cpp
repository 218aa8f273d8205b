// Effects of speed and load, worked by hand.
//
// With tau = 100 s / ln 2 the low pass of low_pass.hpp goes half the way in 100 s and three quarters in 200 s. Along a
// straight line it gains 1 - a tau / dt of the input's change: 1 - 0.5 / ln 2 = 0.2786525 in 100 s and
// 1 - 0.75 / (2 ln 2) = 0.4589894 in 200 s.
#include <gtest/gtest.h>

#include <numbers>

#include "drift_values.hpp"

namespace ballbar {
namespace {

constexpr double kTau = 100.0 / std::numbers::ln2;

void expect_near(const std::vector<double>& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  // The hand's values have seven decimals.
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 5e-7) << "row " << i;
}

// 0.5 um at 1000 rpm: 0.5 * 2^2 = 2 and 0.5 * 3^2 = 4.5, whatever the direction, and 0 at once at rest.
TEST(CentrifugalShift, GoesWithTheSquareAndReversesAtOnce) {
  expect_near(drift_values("centrifugal_shift", {0, 1, 5, 6}, {{0, -2000, 3000, 0}}, {0.5, 2.0}).values,
              {0.0, 2.0, 4.5, 0.0});
}

// dv/dp = k n^p ln n: 0.5 * 4 * ln 2 = 1.3862944.
TEST(CentrifugalShift, HasTheExponentsDerivative) {
  const DriftValues shift = drift_values("centrifugal_shift", {0, 1}, {{0, 2000}}, {0.5, 2.0});
  expect_near(shift.derivatives, {0.0, 0.0, 4.0, 2.0 * std::numbers::ln2});
}

// tau_on = 100 s / ln 2, tau_off twice that, a = 1, n in krpm 0, 2, 2, 0, 0 at 0, 100, 300, 400, 600 s.
//   100 s  ramp up, turns:      0.2786525 * 2                                       = 0.5573050
//   300 s  0.5573050 + 0.75 (2 - 0.5573050)                                         = 1.6393263
//   400 s  ramp down, turns:    1.6393263 + 0.5 (2 - 1.6393263) - 2 * 0.2786525     = 1.2623582
//   600 s  at rest, half of it is left                                              = 0.6311791
TEST(CoolingAsymmetry, WarmsFasterThanItCools) {
  expect_near(
      drift_values("cooling_asymmetry", {0, 100, 300, 400, 600}, {{0, 2000, 2000, 0, 0}}, {1.0, kTau, 2.0 * kTau, 1.0})
          .values,
      {0.0, 0.5573050, 1.6393263, 1.2623582, 0.6311791});
}

TEST(CoolingAsymmetry, IsSpeedHeatingWhereBothTimeConstantsAgree) {
  const std::vector<double> time_s{0, 70, 300, 420, 1000};
  const std::vector<std::vector<double>> speed{{0, 2000, 3000, 0, 0}};
  expect_near(drift_values("cooling_asymmetry", time_s, speed, {2.0, 500.0, 500.0, 5.0 / 3.0}).values,
              drift_values("speed_heating", time_s, speed, {2.0, 500.0, 5.0 / 3.0}).values);
}

// b = ln 2 / 10 K halves the friction every 10 K: n exp(-b (T - T0)) = 4, 2, 1 at 4000 rpm.
//   0 s    4
//   100 s  4 - 2 * 0.2786525                              = 3.4426950
//   300 s  3.4426950 + 0.75 (2 - 3.4426950) - 0.4589894   = 1.9016844        and twice that for a gain of 2
TEST(ViscosityFeedback, HalvesTheFrictionEveryTenKelvin) {
  expect_near(drift_values("viscosity_feedback", {0, 100, 300}, {{4000, 4000, 4000}, {20, 30, 40}},
                           {2.0, kTau, std::numbers::ln2 / 10.0})
                  .values,
              {8.0, 6.8853900, 3.8033688});
}

TEST(ViscosityFeedback, IsSpeedHeatingWhereTheLubricantDoesNotChange) {
  const std::vector<double> time_s{0, 70, 300};
  expect_near(drift_values("viscosity_feedback", time_s, {{0, 2000, 3000}, {20, 30, 40}}, {2.0, 500.0, 0.0}).values,
              drift_values("speed_heating", time_s, {{0, 2000, 3000}}, {2.0, 500.0, 1.0}).values);
}

// 0, then 10 * 0.2786525 = 2.7865248, then 10 - (10 - 2.7865248) / 4 = 8.1966312 W; 3 um/W.
TEST(LoadHeating, FollowsTheLoadSlowly) {
  expect_near(drift_values("load_heating", {0, 100, 300}, {{0, 10, 10}}, {3.0, kTau}).values,
              {0.0, 8.3595744, 24.5898936});
}

}  // namespace
}  // namespace ballbar
