// Effects of a difference of temperatures, worked by hand. The low pass's numbers are those of speed_and_load_test.cpp.
#include <gtest/gtest.h>

#include <numbers>

#include "drift_values.hpp"

namespace ballbar {
namespace {

constexpr double kTau = 100.0 / std::numbers::ln2;
const std::vector<double> kTime{0, 100, 300};
const std::vector<std::vector<double>> kWalls{{20, 24, 26}, {18, 19, 20}};  // hot - cold since the start: 0, 3, 4 K

void expect_near(const std::vector<double>& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 5e-7) << "row " << i;
}

// Without lag 2 um/K of 0, 3, 4 K. From the right, d/dtau = -gain slope: -2 * 3 / 100 and -2 * 1 / 200.
TEST(GradientBending, IsAtOnceWithoutLag) {
  const DriftValues bent = drift_values("gradient_bending", kTime, kWalls, {2.0, 0.0});
  expect_near(bent.values, {0.0, 6.0, 8.0});
  expect_near(bent.derivatives, {0.0, 0.0, 3.0, -0.06, 4.0, -0.01});
}

// 3 * 0.2786525 = 0.8359574, then 0.8359574 + 0.75 (3 - 0.8359574) + 1 * 0.4589894 = 2.9179788; 2 um/K.
TEST(GradientBending, FollowsTheDifferenceSlowly) {
  expect_near(drift_values("gradient_bending", kTime, kWalls, {2.0, kTau}).values, {0.0, 1.6719149, 5.8359574});
}

TEST(GradientBending, IsNothingWhereBothSidesWarmAlike) {
  expect_near(drift_values("gradient_bending", kTime, {{20, 24, 26}, {18, 22, 24}}, {2.0, kTau}).values,
              {0.0, 0.0, 0.0});
}

// 100 mm * 12 ppm/K * 1.5 K = 1.8 um, and -2 K give -2.4 um. 20 °C counts, not the first row.
TEST(BarTemperature, CountsFromTwentyDegrees) {
  expect_near(drift_values("bar_temperature", kTime, {{21.5, 20, 18}}, {12.0, 100.0}).values, {1.8, 0.0, -2.4});
}

}  // namespace
}  // namespace ballbar
