// Effects that belong to the angle or to the whole circle: values worked by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "readings.hpp"

namespace ballbar {
namespace {

// Centre (300, 400) um and radius + 50 um on a 100 mm bar. At 0 deg the ball is at (100.35, 0.4) mm:
// sqrt(100.35^2 + 0.4^2) = 100.350797206... mm.
TEST(circle, is_the_length_equation) {
  const double length_mm = std::sqrt(100.35 * 100.35 + 0.4 * 0.4);
  EXPECT_NEAR(added_um("circle", {300.0, 400.0, 50.0, -1.0}, {.angle_deg = 0.0}), (length_mm - 100.0) * 1e3, 1e-7);
  EXPECT_NEAR(length_mm, 100.3507972063, 1e-9);
  // with the balls 5 mm apart in height, no offset: sqrt(100^2 + 5^2) - 100 = 0.1249219725 mm
  EXPECT_NEAR(added_um("circle", {0.0, 0.0, 0.0, -1.0}, {.height_mm = 5.0}), 124.9219725, 1e-6);
}

TEST(circle, is_zero_in_other_recordings) {
  const std::vector<Reading> readings{{.recording = 0.0}, {.recording = 1.0}};
  const std::vector<double> second = all_added_um("circle", {7.0, 0.0, 0.0, 1.0}, readings);
  EXPECT_EQ(second[0], 0.0);
  EXPECT_NEAR(second[1], 7.0, 1e-9);
  const std::vector<double> all = all_added_um("circle", {7.0, 0.0, 0.0, -1.0}, readings);
  EXPECT_NEAR(all[0], 7.0, 1e-9);
  EXPECT_NEAR(all[1], 7.0, 1e-9);
}

// Renishaw stores 2 R (s_a - s_b): 30 ppm on 50 mm are 3.0 um over the diameter, and + - 0.75 um on the length.
TEST(scale_mismatch, lengthens_along_a_and_shortens_along_b) {
  const auto at = [](double angle_deg) {
    return added_um("scale_mismatch", {3.0}, {.angle_deg = angle_deg, .radius_mm = 50.0});
  };
  EXPECT_NEAR(at(0.0), 0.75, kRounding_um);
  EXPECT_NEAR(at(45.0), 0.0, kRounding_um);
  EXPECT_NEAR(at(90.0), -0.75, kRounding_um);
}

// An angle of 90 deg + 20 um/m from +A to +B: the corner at 45 deg is 50 mm * 20 um/m = 1 um too near.
TEST(squareness, shortens_at_45_deg_where_the_angle_is_obtuse) {
  EXPECT_NEAR(added_um("squareness", {20.0}, {.angle_deg = 45.0}), -1.0, kRounding_um);
  EXPECT_NEAR(added_um("squareness", {20.0}, {.angle_deg = 135.0, .direction = kCw}), 1.0, kRounding_um);
  // the exact length: B's axis is turned by 20 urad towards -A
  const double a_mm = 100.0 * (std::cos(rad_from_deg(30.0)) - 20e-6 * std::sin(rad_from_deg(30.0)));
  const double b_mm = 100.0 * std::sin(rad_from_deg(30.0));
  EXPECT_NEAR(added_um("squareness", {20.0}, {.angle_deg = 30.0}), (std::hypot(a_mm, b_mm) - 100.0) * 1e3, 1e-4);
}

// A bow of 8 um is 8 cos^2 sin = 2 sin + 2 sin 3: the circle keeps the three lobes of 2 um, the rest is its centre.
TEST(straightness, has_three_lobes_of_a_quarter_of_the_bow) {
  EXPECT_NEAR(added_um("straightness_a", {8.0}, {.angle_deg = 30.0}), 2.0, kRounding_um);
  EXPECT_NEAR(added_um("straightness_a", {8.0}, {.angle_deg = 90.0}), -2.0, kRounding_um);
  EXPECT_NEAR(added_um("straightness_a", {8.0}, {.angle_deg = 60.0, .direction = kCw}), 0.0, kRounding_um);
  EXPECT_NEAR(added_um("straightness_b", {8.0}, {.angle_deg = 0.0}), -2.0, kRounding_um);
  EXPECT_NEAR(added_um("straightness_b", {8.0}, {.angle_deg = 60.0, .direction = kCw}), 2.0, kRounding_um);
  // with its part of the centre it is the bow: at 45 deg, cos^2 = 1/2 and sin = 0.7071 leave 2.828 um
  const double theta_rad = rad_from_deg(45.0);
  EXPECT_NEAR(added_um("straightness_a", {8.0}, {.angle_deg = 45.0}) + 2.0 * std::sin(theta_rad), 8.0 / std::sqrt(8.0),
              kRounding_um);
  EXPECT_NEAR(added_um("straightness_b", {8.0}, {.angle_deg = 45.0}) + 2.0 * std::cos(theta_rad), 8.0 / std::sqrt(8.0),
              kRounding_um);
}

// 6 (4 x^3 - 3 x) along A and 6 (4 y^3 - 3 y) along B: at 0 deg 6 um along A and nothing along B, 3 of them of the
// second harmonic, which is left to scale and squareness.
TEST(cubic_error, has_four_lobes_alike_in_both_directions) {
  EXPECT_NEAR(added_um("cubic_error", {6.0, 0.0}, {.angle_deg = 0.0}), 3.0, kRounding_um);
  EXPECT_NEAR(added_um("cubic_error", {6.0, 0.0}, {.angle_deg = 45.0, .direction = kCw}), -3.0, kRounding_um);
  EXPECT_NEAR(added_um("cubic_error", {6.0, 0.0}, {.angle_deg = 22.5}), 0.0, kRounding_um);
  EXPECT_NEAR(added_um("cubic_error", {0.0, 4.0}, {.angle_deg = 22.5}), 2.0, kRounding_um);
  EXPECT_NEAR(added_um("cubic_error", {0.0, 4.0}, {.angle_deg = 67.5, .direction = kCw}), -2.0, kRounding_um);
  // with cos 2 theta it is the error of axis A along the bar
  const double theta_rad = rad_from_deg(20.0), x = std::cos(theta_rad);
  EXPECT_NEAR(added_um("cubic_error", {6.0, 0.0}, {.angle_deg = 20.0}) + 3.0 * std::cos(2.0 * theta_rad),
              6.0 * (4.0 * x * x * x - 3.0 * x) * x, kRounding_um);
}

TEST(oval, has_two_lobes) {
  EXPECT_NEAR(added_um("oval", {3.0, 2.0}, {.angle_deg = 180.0}), 3.0, kRounding_um);
  EXPECT_NEAR(added_um("oval", {3.0, 2.0}, {.angle_deg = 45.0}), 2.0, kRounding_um);
  EXPECT_EQ(find_effect("oval", Level::recording)->motions, (std::vector{Motion::rotary_axis, Motion::spindle}));
}

TEST(lobing, has_k_lobes) {
  EXPECT_NEAR(added_um("lobing", {3.0, 2.0, 3.0}, {.angle_deg = 120.0}), 3.0, kRounding_um);
  EXPECT_NEAR(added_um("lobing", {3.0, 2.0, 5.0}, {.angle_deg = 18.0}), 2.0, kRounding_um);
}

// A steel bar of 100 mm at 25 degC: 100 mm * 11.5e-6 / K * 5 K = 5.75 um longer, so that much too little is read.
TEST(bar_temperature, makes_a_warm_bar_read_too_little) {
  EXPECT_NEAR(added_um("bar_temperature", {11.5}, {.bar_degC = 25.0}), -5.75, kRounding_um);
  EXPECT_EQ(added_um("bar_temperature", {11.5}, {.bar_degC = 20.0}), 0.0);
}

}  // namespace
}  // namespace ballbar
