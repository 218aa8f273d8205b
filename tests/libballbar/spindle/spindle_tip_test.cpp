// What temperatures do to the tip, by hand.
#include "spindle/spindle_tip.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spindle/spindle_network.hpp"

namespace ballbar::thermal {
namespace {

// A kelvin everywhere, alpha = 11.7: shaft from the middle of the front bearing, 335 mm, to 520 mm; housing from the
// flange at 200 mm to 335 mm. Rings and balls keep their fit: 36 + 10 - 46 mm.
TEST(SpindleTip, ElongationOfAKelvin) {
  const FiniteVolumeSpindle spindle;
  const Cells cells = cells_of(spindle);
  const Eigen::VectorXd um = tip_um_per_K(spindle, {}, cells) * Eigen::VectorXd::Ones(cells.nodes());
  EXPECT_NEAR(um[z_shaft], 11.7e-3 * 185.0, 1e-12);
  EXPECT_NEAR(um[z_housing], 11.7e-3 * 135.0, 1e-12);
  EXPECT_NEAR(um[z_rings], 0.0, 1e-12);
  EXPECT_NEAR(um[x_bending], 0.0, 1e-12);
  EXPECT_NEAR(um[z_structure], -10.5e-3 * 500.0, 1e-12);
  EXPECT_NEAR(um[y_structure], 10.5e-3 * 300.0, 1e-12);
}

// Sum of alpha dT dx: one cell of 10 mm, all of it beyond the bearing, 3 K warmer: 11.7e-3 * 10 * 3.
TEST(SpindleTip, ElongationOfOneCell) {
  const FiniteVolumeSpindle spindle;
  const Cells cells = cells_of(spindle);
  Eigen::VectorXd rise_K = Eigen::VectorXd::Zero(cells.nodes());
  rise_K[cells.shaft_node(40)] = 3.0;
  EXPECT_NEAR((tip_um_per_K(spindle, {}, cells) * rise_K)[z_shaft], 0.351, 1e-12);
}

// Shaft 5 K warmer than balls and housing: 36 mm * 11.7e-3 um/mm/K * 5 K / tan 25 deg = 4.516 um forward.
TEST(SpindleTip, WarmInnerRingWedgesTheRotorForward) {
  const FiniteVolumeSpindle spindle;
  const Cells cells = cells_of(spindle);
  Eigen::VectorXd rise_K = Eigen::VectorXd::Zero(cells.nodes());
  for (std::size_t i = 0; i < cells.shaft.size(); ++i) rise_K[cells.shaft_node(i)] = 5.0;
  EXPECT_NEAR((tip_um_per_K(spindle, {}, cells) * rise_K)[z_rings], 4.516, 1e-3);
}

// +x a kelvin warmer than -x all along: curvature kappa = 11.7e-6 / (2 * 70 mm * sin 45 deg / (pi / 4)) = 9.2825e-8 /mm
// towards -x. The clamped tube is off by kappa 135^2 / 2 = 0.8459 um at the front bearing and kappa 147.5^2 / 2 =
// 1.0098 um at the rear one, 282.5 mm behind it; the line through both is off by 0.8459 - 0.1639 * 185 / 282.5 = 0.7385
// um at the ball.
TEST(SpindleTip, WarmSideBendsTheHousingAway) {
  const FiniteVolumeSpindle spindle;
  const Cells cells = cells_of(spindle);
  Eigen::VectorXd rise_K = Eigen::VectorXd::Zero(cells.nodes());
  for (std::size_t j = 0; j < cells.housing.size(); ++j) rise_K[cells.housing_node(j, plus_x)] = 1.0;
  const Eigen::VectorXd um = tip_um_per_K(spindle, {}, cells) * rise_K;
  EXPECT_NEAR(um[x_bending], -0.7385, 1e-4);
  EXPECT_EQ(um[y_bending], 0.0);
}

// The column's front a kelvin warmer: it grows 10.5e-3 * 500 / 2 = 2.625 um, tilts by 10.5e-6 * 500 / 400 = 13.125
// urad, which lifts the nose 300 mm in front of it by 3.9375 um, and its top bows back by 13.125e-6 * 500 / 2 mm =
// 3.28125 um.
TEST(SpindleTip, WarmFrontOfTheColumnTiltsTheHead) {
  const FiniteVolumeSpindle spindle;
  const Cells cells = cells_of(spindle);
  const Eigen::VectorXd um =
      tip_um_per_K(spindle, {}, cells) * Eigen::VectorXd::Unit(cells.nodes(), cells.column_front());
  EXPECT_NEAR(um[z_structure], -2.625 - 3.9375, 1e-9);
  EXPECT_NEAR(um[y_structure], -3.28125, 1e-9);
}

// w = 2094.395 rad/s, no contraction without Poisson's ratio, no balls without their density: for 30 < r < 32 mm
// u = 7850 w^2 / 208e9 * 0.032 / 4 * (0.032^2 + 3 * 0.030^2) = 4.932 um, and tan 45 deg = 1.
TEST(SpindleTip, RingGrowsByTurning) {
  FiniteVolumeSpindle spindle;
  spindle.bore_radius_mm = 30.0;
  spindle.poisson = 0.0;
  spindle.ball_density_kg_per_m3 = 0.0;
  spindle.contact_angle_deg = 45.0;
  EXPECT_NEAR(centrifugal_um(spindle, 20000.0), 4.932, 1e-3);
}

// A shaft with nu = 0.29 contracts over 420 - 335 = 85 mm by 0.29 * 0.165547 * (0.012^2 + 0.032^2) / 2 * 0.085 m =
// 2.383 um; its ring grows by 0.165547 * 0.008 * (0.71 * 0.032^2 + 3.29 * 0.012^2) = 1.590 um.
TEST(SpindleTip, ShaftContractsByTurning) {
  FiniteVolumeSpindle spindle;
  spindle.ball_density_kg_per_m3 = 0.0;
  spindle.contact_angle_deg = 45.0;
  EXPECT_NEAR(centrifugal_um(spindle, 20000.0), 1.590 - 2.383, 2e-3);
}

// Contact angle 30 deg thrown to 20 deg outside: cos a_i = 2 cos 30 - cos 20 = 0.792358, a_i = 37.5936 deg, so
// cot a_o - cot a_i = 1.448649; the rotor moves by 0.02 * 10 mm * (sin 20 + sin 37.5936 - 2 sin 30) = -9.585 um. A ball
// of 1.67552e-3 kg at w / 2 (1 - 10 cos 30 / 80) = 933.835 rad/s, 40 mm out, pulls 58.4452 N: 20 of them at
// P = 58.4452 * 20 / 1.448649 = 806.893 N.
TEST(SpindleTip, BallsThrownOutwardsDrawTheRotorIn) {
  FiniteVolumeSpindle spindle;
  spindle.contact_angle_deg = 30.0;
  spindle.front_pitch_mm = 80.0;
  spindle.front_rows = 1.0;
  spindle.bearing_load_N = 806.893;
  EXPECT_NEAR(ball_shift_um(spindle, 20000.0), -9.585, 1e-3);
  EXPECT_NEAR(ball_shift_um(spindle, 0.0), 0.0, 1e-9);
  // Springs far too weak: a_o goes to 0 and a_i to where cos a_i = 2 cos 30 - 1, 42.94 deg.
  EXPECT_NEAR(ball_shift_um(spindle, 2e6), 200.0 * (std::sqrt(1.0 - 0.7320508 * 0.7320508) - 1.0), 0.2);
}

}  // namespace
}  // namespace ballbar::thermal
