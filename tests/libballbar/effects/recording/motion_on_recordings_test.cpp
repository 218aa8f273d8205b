// Effects that depend on feed, time or position: values worked by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "readings.hpp"

namespace ballbar {
namespace {

// 3000 mm/min = 50 um/ms, half of it times 0.2 ms: 5 um at 45 deg, the other way round clockwise.
TEST(servo_mismatch, changes_sign_with_the_direction) {
  EXPECT_NEAR(added_um("servo_mismatch", {0.2}, {.angle_deg = 45.0}), 5.0, kRounding_um);
  EXPECT_NEAR(added_um("servo_mismatch", {0.2}, {.angle_deg = 45.0, .direction = kCw}), -5.0, kRounding_um);
  EXPECT_NEAR(added_um("servo_mismatch", {0.2}, {.angle_deg = 45.0, .feed_mm_per_min = 1500.0}), 2.5, kRounding_um);
  // the exact length: A 0.2 ms late at 50 um/ms on 100 mm is 0.1 mrad behind
  const double a_mm = 100.0 * std::cos(rad_from_deg(30.0) - 1e-4), b_mm = 100.0 * std::sin(rad_from_deg(30.0));
  EXPECT_NEAR(added_um("servo_mismatch", {0.2}, {.angle_deg = 30.0}), (std::hypot(a_mm, b_mm) - 100.0) * 1e3, 1e-3);
}

// 0.5 um at 1 m/min are 4.5 um at 3 m/min.
TEST(dynamic_contraction, grows_with_the_square_of_the_feed) {
  EXPECT_NEAR(added_um("dynamic_contraction", {0.5}, {.feed_mm_per_min = 1000.0}), -0.5, kRounding_um);
  EXPECT_NEAR(added_um("dynamic_contraction", {0.5}, {.feed_mm_per_min = 3000.0}), -4.5, kRounding_um);
}

// 4 um from peak to peak in one direction, at the other angles in the other.
TEST(sin_4_theta, has_four_lobes_that_turn_with_the_direction) {
  EXPECT_NEAR(added_um("sin_4_theta", {4.0}, {.angle_deg = 22.5}), 2.0, kRounding_um);
  EXPECT_NEAR(added_um("sin_4_theta", {4.0}, {.angle_deg = 22.5, .direction = kCw}), -2.0, kRounding_um);
  EXPECT_NEAR(added_um("sin_4_theta", {4.0}, {.angle_deg = 67.5}), -2.0, kRounding_um);
  EXPECT_NEAR(added_um("sin_4_theta", {4.0}, {.angle_deg = 45.0}), 0.0, kRounding_um);
}

// At 60 deg A is at 50 mm of 100 and moves towards -A when CCW. Pitch 8 mm, 6.25 waves, a quarter: the sine is 1 and
// the cosine 0, times 1/2 of the bar and 1/2 of peak to peak.
TEST(cyclic_error, is_fixed_in_the_position_of_the_axis) {
  const std::vector<double> quarter{2.0, 7.0, 4.0, 5.0, 8.0};  // fwd sine, cosine, rev sine, cosine, pitch
  EXPECT_NEAR(added_um("cyclic_error_a", quarter, {.angle_deg = 60.0}), 1.0, 1e-8);
  EXPECT_NEAR(added_um("cyclic_error_a", quarter, {.angle_deg = 60.0, .direction = kCw}), 0.5, 1e-8);
  EXPECT_NEAR(added_um("cyclic_error_a", quarter, {.angle_deg = -60.0}), 0.5, 1e-8);
  EXPECT_NEAR(added_um("cyclic_error_a", quarter, {.angle_deg = 90.0}), 0.0, 1e-8);
  // B at 30 deg is at + 50 mm and moves towards +B when CCW
  EXPECT_NEAR(added_um("cyclic_error_b", quarter, {.angle_deg = 30.0}), 0.5, 1e-8);
  EXPECT_NEAR(added_um("cyclic_error_b", quarter, {.angle_deg = 30.0, .direction = kCw}), 1.0, 1e-8);
  const std::vector<double> whole{2.0, 7.0, 4.0, 5.0, 10.0};  // 5 waves: the cosine is 1
  EXPECT_NEAR(added_um("cyclic_error_b", whole, {.angle_deg = 30.0}), 1.75, 1e-8);
  EXPECT_NEAR(added_um("cyclic_error_b", whole, {.angle_deg = 30.0, .direction = kCw}), 1.25, 1e-8);
}

// 5 Hz: a quarter of a wave 50 ms after the middle of the sweep.
TEST(vibration, is_a_wave_in_time_with_a_phase_for_each_direction) {
  const std::vector<double> p{3.0, 4.0, 5.0, 6.0, 5.0, -1.0};
  EXPECT_NEAR(added_um("vibration", p, {.sweep_s = 0.05}), 3.0, kRounding_um);
  EXPECT_NEAR(added_um("vibration", p, {.sweep_s = 0.0}), 4.0, kRounding_um);
  EXPECT_NEAR(added_um("vibration", p, {.direction = kCw, .sweep_s = 0.05}), 5.0, kRounding_um);
  EXPECT_NEAR(added_um("vibration", p, {.direction = kCw, .sweep_s = 0.2}), 6.0, kRounding_um);
  EXPECT_EQ(added_um("vibration", {3.0, 4.0, 5.0, 6.0, 5.0, 1.0}, {.sweep_s = 0.05}), 0.0);
}

TEST(sweep_drift, is_zero_in_the_middle_of_the_sweep) {
  EXPECT_NEAR(added_um("sweep_drift", {6.0}, {.sweep_s = 5.0}), 0.5, kRounding_um);
  EXPECT_NEAR(added_um("sweep_drift", {6.0}, {.direction = kCw, .sweep_s = -5.0}), -0.5, kRounding_um);
}

TEST(centre_drift, moves_the_centre) {
  EXPECT_NEAR(added_um("centre_drift", {6.0, 12.0}, {.angle_deg = 180.0, .sweep_s = 5.0}), -0.5, kRounding_um);
  EXPECT_NEAR(added_um("centre_drift", {6.0, 12.0}, {.angle_deg = 90.0, .sweep_s = 5.0}), 1.0, kRounding_um);
}

TEST(mounting_slip, steps_at_the_onset_and_stays) {
  const std::vector<double> values =
      all_added_um("mounting_slip", {2.0, 0.5}, {{.time_s = 0.5}, {.time_s = 1.0}, {.time_s = 30.0}});
  EXPECT_EQ(values, (std::vector{0.0, 2.0, 2.0}));
}

}  // namespace
}  // namespace ballbar
