#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/history/history.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr std::int64_t kDay = 86400;

MachineTest test_in(Plane plane, std::int64_t started_s, double a_ppm, double b_ppm, double sigma_ppm,
                    double squareness) {
  MachineTest test;
  test.plane = plane;
  test.started_s = started_s;
  test.scales = AxisScales{a_ppm, b_ppm, sigma_ppm * sigma_ppm * Eigen::Matrix2d::Identity()};
  test.squareness = MachineError{"the plane's", "um/m", squareness, 1.5};
  return test;
}

// X 10, Y 20, Z 30 in every plane: as they are, each from two tests with sigma 1.
TEST(machine_geometry, planes_that_agree) {
  const std::vector<MachineTest> tests{test_in(Plane::XY, 0, 10, 20, 1, 5), test_in(Plane::YZ, 60, 20, 30, 1, 6),
                                       test_in(Plane::ZX, 120, 30, 10, 1, 7)};
  const MachineGeometry found = machine_geometry(tests);
  ASSERT_EQ(found.scales.size(), 3u);
  for (int axis = 0; axis < 3; ++axis) {
    const AxisScale& scale = found.scales[static_cast<std::size_t>(axis)];
    EXPECT_EQ(scale.axis, axis);
    EXPECT_NEAR(scale.value_ppm, 10.0 * (axis + 1), 1e-9);
    EXPECT_NEAR(scale.sigma_ppm, std::sqrt(0.5), 1e-9);
    EXPECT_EQ(scale.planes, 2u);
  }
  EXPECT_EQ(found.agreement.degrees, 3u);
  EXPECT_NEAR(found.agreement.chi2, 0.0, 1e-12);
  EXPECT_TRUE(found.within_a_day);
  ASSERT_EQ(found.squareness.size(), 3u);
  EXPECT_EQ(found.squareness[1].plane, Plane::YZ);
  EXPECT_EQ(found.squareness[1].value, 6.0);
  EXPECT_EQ(found.squareness[1].sigma, 1.5);
}

// Two planes share Y, which they see 6 um/m apart, sigma 1 and 1: chi^2 = 36 / 2 = 18 at one degree, each pull
// 3 / sqrt(1 / 2), the scale in the middle. With a variance of 17 more each chi^2 is 1: sigma of Y sqrt(18 / 2), of X
// sqrt(18).
TEST(machine_geometry, planes_that_disagree) {
  const std::vector<MachineTest> tests{test_in(Plane::XY, 0, 10, 20, 1, 5), test_in(Plane::YZ, 60, 26, 30, 1, 6)};
  const MachineGeometry found = machine_geometry(tests);
  EXPECT_EQ(found.agreement.degrees, 1u);
  EXPECT_NEAR(found.agreement.chi2, 18.0, 1e-9);
  EXPECT_NEAR(found.agreement.p_value, chi2_upper_tail(18.0, 1), 1e-12);
  EXPECT_NEAR(found.agreement.scatter_ppm, std::sqrt(17.0), 1e-6);
  EXPECT_NEAR(found.scales[0].value_ppm, 10.0, 1e-9);
  EXPECT_NEAR(found.scales[0].sigma_ppm, std::sqrt(18.0), 1e-6);
  EXPECT_NEAR(found.scales[1].value_ppm, 23.0, 1e-9);
  EXPECT_NEAR(found.scales[1].sigma_ppm, 3.0, 1e-6);
  ASSERT_EQ(found.agreement.pulls.size(), 4u);
  EXPECT_TRUE(std::isnan(found.agreement.pulls[0].pull)) << "X is in one plane alone";
  EXPECT_NEAR(found.agreement.pulls[1].pull, -std::sqrt(18.0), 1e-9);
  EXPECT_NEAR(found.agreement.pulls[2].pull, std::sqrt(18.0), 1e-9);
}

// Scales of one test go together through the common radius: X follows what Y's other test says. C = [[2, 1], [1, 2]] of
// XY, Y again 3 higher with sigma 1: weights of Y 1/2 and 1, Y = 20 + 2, X = 10 + 1/2 (22 - 20) = 11.
TEST(machine_geometry, the_covariance_of_a_test_counts) {
  std::vector<MachineTest> tests{test_in(Plane::XY, 0, 10, 20, 1, 5), test_in(Plane::YZ, 60, 23, 30, 1, 6)};
  tests[0].scales->covariance << 2, 1, 1, 2;
  const MachineGeometry found = machine_geometry(tests);
  EXPECT_NEAR(found.scales[1].value_ppm, 22.0, 1e-9);
  EXPECT_NEAR(found.scales[0].value_ppm, 11.0, 1e-9);
  EXPECT_NEAR(found.agreement.chi2, 3.0, 1e-9) << "9 / (2 + 1)";
}

TEST(machine_geometry, newest_of_each_plane_and_all_of_the_last_day) {
  const std::vector<MachineTest> tests{test_in(Plane::XY, 0, 1, 1, 1, 1), test_in(Plane::ZX, 10 * kDay, 2, 2, 1, 2),
                                       test_in(Plane::XY, 100 * kDay - 3600, 3, 3, 1, 3),
                                       test_in(Plane::XY, 100 * kDay, 5, 5, 1, 5)};
  const MachineGeometry found = machine_geometry(tests);
  EXPECT_EQ(found.tests, (std::vector<std::size_t>{2, 3, 1}));
  EXPECT_FALSE(found.within_a_day);
  EXPECT_EQ(found.squareness[0].value, 4.0);
  EXPECT_NEAR(found.squareness[0].sigma, 1.5 / std::sqrt(2.0), 1e-12);
}

TEST(machine_geometry, stored_values_stand_without_sigma) {
  std::vector<MachineTest> tests{test_in(Plane::XY, 0, 10, 20, 1, 5), test_in(Plane::YZ, 60, 22, 30, 1, 6)};
  for (MachineTest& test : tests) {
    test.stored = true;
    test.scales->covariance.setConstant(kUnknown);
    test.squareness->sigma = kUnknown;
  }
  const MachineGeometry found = machine_geometry(tests);
  EXPECT_NEAR(found.scales[1].value_ppm, 21.0, 1e-9);
  EXPECT_TRUE(std::isnan(found.scales[1].sigma_ppm));
  EXPECT_EQ(found.agreement.degrees, 0u);
  EXPECT_TRUE(std::isnan(found.squareness[0].sigma));
}

TEST(machine_geometry, nothing_of_nothing) {
  const std::vector<MachineTest> tests(2);
  const MachineGeometry found = machine_geometry(tests);
  EXPECT_TRUE(found.tests.empty());
  EXPECT_TRUE(found.scales.empty());
  EXPECT_TRUE(found.squareness.empty());
}

}  // namespace
}  // namespace ballbar
