// Effects of the bearing, worked by hand.
#include <gtest/gtest.h>

#include "drift_values.hpp"

namespace ballbar {
namespace {

const std::vector<double> kTime{0, 100, 300, 330};

void expect_near(const std::vector<double>& values, const std::vector<double>& expected, double tolerance_um = 1e-12) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance_um) << "row " << i;
}

// 13.6 ppm/K: the inner raceway of 27.34 mm grows 3.71824 um in 10 K and closes, the outer one of 37.66 mm grows
// 5.12176 um and opens; both together open 1.40352 um. Half of the formula with a gain of 0.5.
TEST(BearingRings, OpenByTheOuterAndCloseByTheInner) {
  const std::vector<std::vector<double>> rings{{20, 30, 20, 30}, {19, 19, 29, 29}};
  expect_near(drift_values("bearing_rings", kTime, rings, {1.0, 27.34, 37.66, 13.6}).values,
              {0.0, -3.71824, 5.12176, 1.40352});
  expect_near(drift_values("bearing_rings", kTime, rings, {0.5, 27.34, 37.66, 13.6}).values,
              {0.0, -1.85912, 2.56088, 0.70176});
}

// dL = 20.20 um, D_w (f - 0.5) = 309.57 um: sin 18 deg - 16.16 / 309.57 = 0.3090170 - 0.0522014 = 0.2568156, alpha =
// 14.8811 deg, theta = (180 - 3.1189) / 2 - 72 = 16.4405 deg, c = 16.16 * 0.295085 = 4.76858 um. Elongation counts from
// the first row.
TEST(BearingClearance, IsHuangsFormula) {
  expect_near(drift_values("bearing_clearance", kTime, {{5.0, 25.2, 5.0, 25.2}}, {1.0, 10.319, 0.53}).values,
              {0.0, 4.76858, 0.0, 4.76858}, 2e-4);
}

// No elongation, no clearance. Small ones: c = 0.8 dL tan 18 deg = 0.25994 dL. Where 0.8 dL = 309.57 um * sin 18 deg
// the contact angle is 0: theta = 81 - 72 = 9 deg, c = 309.57 * sin 18 deg * tan 9 deg = 15.1514 um. Twice the gain:
// twice c.
TEST(BearingClearance, StartsWithTan18AndBends) {
  const std::vector<double> axial_um{0.0, 1e-3, 309.57 * 0.30901699 / 0.8};
  const std::vector<double> c_um = drift_values("bearing_clearance", {0, 1, 2}, {axial_um}, {2.0, 10.319, 0.53}).values;
  EXPECT_EQ(c_um[0], 0.0);
  EXPECT_NEAR(c_um[1], 2.0 * 0.25994e-3, 2e-8);
  EXPECT_NEAR(c_um[2], 2.0 * 15.1514, 4e-4);
}

// Beyond the arcsin the angle stays: alpha = -90 deg, theta = (180 - 108) / 2 - 72 = -36 deg, 800 um * tan(-36 deg) =
// -581.2340 um; and 90 deg, theta = (180 + 72) / 2 - 72 = 54 deg, -800 * tan 54 deg = -1101.1055 um.
TEST(BearingClearance, StaysFiniteBeyondTheBearing) {
  expect_near(drift_values("bearing_clearance", {0, 1, 2}, {{0, 1000, -1000}}, {1.0, 10.319, 0.53}).values,
              {0.0, -581.2340, -1101.1055}, 1e-4);
}

// Rise 0, 2, 5, 3 K; 3 K are free, so that 2 K are left once: 1.5 um/K * 2 K.
TEST(PreloadLoss, HasItsKinkAtTheThreshold) {
  const DriftValues loss = drift_values("preload_loss", kTime, {{20, 22, 25, 23}}, {1.5, 3.0});
  expect_near(loss.values, {0.0, 0.0, 3.0, 0.0});
  expect_near(loss.derivatives, {0.0, 0.0, 0.0, 0.0, 2.0, -1.5, 0.0, 0.0});
}

// 20 um of elongation of a spindle inclined by 0.1 mm/m shift it by 0.002 um.
TEST(AxialCrosstalk, IsInProportion) {
  expect_near(drift_values("axial_crosstalk", kTime, {{5, 25, 5, -5}}, {1e-4}).values, {0.0, 0.002, 0.0, -0.001});
}

}  // namespace
}  // namespace ballbar
