// Effects at the reversals of an axis: values worked by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "readings.hpp"

namespace ballbar {
namespace {

// CCW through 0 deg: A goes out until 0 and back after it. With 4 um of lost motion it is 2 um short on the way out
// and 2 um too far on the way back: a step outwards of 4 um. At 180 deg the same.
TEST(backlash, steps_outwards_by_the_play_at_the_axis_reversal) {
  const auto at = [](double angle_deg, double direction) {
    return added_um("backlash_a", {4.0, 4.0, 0.0}, {.angle_deg = angle_deg, .direction = direction});
  };
  EXPECT_NEAR(at(-0.01, kCcw), -2.0, 1e-6);
  EXPECT_NEAR(at(0.01, kCcw), 2.0, 1e-6);
  EXPECT_NEAR(at(179.99, kCcw), -2.0, 1e-6);
  EXPECT_NEAR(at(180.01, kCcw), 2.0, 1e-6);
  EXPECT_NEAR(at(0.01, kCw), -2.0, 1e-6);
  EXPECT_NEAR(at(-0.01, kCw), 2.0, 1e-6);
  EXPECT_NEAR(at(60.0, kCcw), 1.0, kRounding_um);
  EXPECT_NEAR(at(90.0, kCcw), 0.0, kRounding_um);
}

TEST(backlash, of_b_steps_at_90_and_270_deg) {
  const auto at = [](double angle_deg, double direction) {
    return added_um("backlash_b", {4.0, 4.0, 0.0}, {.angle_deg = angle_deg, .direction = direction});
  };
  EXPECT_NEAR(at(89.99, kCcw), -2.0, 1e-6);
  EXPECT_NEAR(at(90.01, kCcw), 2.0, 1e-6);
  EXPECT_NEAR(at(269.99, kCcw), -2.0, 1e-6);
  EXPECT_NEAR(at(270.01, kCcw), 2.0, 1e-6);
  EXPECT_NEAR(at(89.99, kCw), 2.0, 1e-6);
}

// 6 um at the + end and 2 um at the - end: 4 um in the middle, 5 um at half the way towards +. Outside of 60 deg A is
// at + 1/2 and, CCW, on its way back: half of 5 um times 1/2.
TEST(backlash, goes_linearly_from_one_end_to_the_other) {
  const auto a = [](double angle_deg) { return added_um("backlash_a", {6.0, 2.0, 0.0}, {.angle_deg = angle_deg}); };
  EXPECT_NEAR(a(0.01) - a(-0.01), 6.0, 1e-6);
  EXPECT_NEAR(a(180.01) - a(179.99), 2.0, 1e-6);
  EXPECT_NEAR(a(60.0), 1.25, kRounding_um);
  EXPECT_NEAR(a(120.0), -0.75, kRounding_um);
  const auto b = [](double angle_deg) { return added_um("backlash_b", {6.0, 2.0, 0.0}, {.angle_deg = angle_deg}); };
  EXPECT_NEAR(b(90.01) - b(89.99), 6.0, 1e-6);
  EXPECT_NEAR(b(270.01) - b(269.99), 2.0, 1e-6);
  EXPECT_NEAR(b(30.0), -1.25, kRounding_um);
}

// 4 um over 1 deg: a quarter of the step after 0.25 deg, all of it after 1 deg; before the reversal nothing.
TEST(backlash, is_taken_up_over_its_width) {
  const auto at = [](double angle_deg, double direction) {
    return added_um("backlash_a", {4.0, 4.0, 1.0}, {.angle_deg = angle_deg, .direction = direction});
  };
  const auto half_play_um = [](double angle_deg) { return 2.0 * std::cos(angle_deg * 0.017453292519943295); };
  EXPECT_NEAR(at(-0.01, kCcw), -2.0, 1e-6);
  EXPECT_NEAR(at(0.25, kCcw), -0.5 * half_play_um(0.25), kRounding_um);
  EXPECT_NEAR(at(0.75, kCcw), 0.5 * half_play_um(0.75), kRounding_um);
  EXPECT_NEAR(at(1.0, kCcw), half_play_um(1.0), kRounding_um);
  EXPECT_NEAR(at(180.25, kCcw), -0.5 * half_play_um(0.25), kRounding_um);
  EXPECT_NEAR(at(-0.25, kCw), -0.5 * half_play_um(0.25), kRounding_um);
}

// 5 um at the + end, 3 um at the - end, width 2 deg: after 2 deg 37 %.
TEST(reversal_spike, falls_after_each_reversal_in_the_direction_of_travel) {
  const auto a = [](double angle_deg, double direction) {
    return added_um("reversal_spike_a", {5.0, 3.0, 2.0}, {.angle_deg = angle_deg, .direction = direction});
  };
  EXPECT_NEAR(a(2.0, kCcw), 5.0 * std::exp(-1.0), kRounding_um);
  EXPECT_NEAR(a(362.0, kCcw), 5.0 * std::exp(-1.0), kRounding_um);
  EXPECT_NEAR(a(182.0, kCcw), 3.0 * std::exp(-1.0), kRounding_um);
  EXPECT_LT(a(358.0, kCcw), 1e-12);
  EXPECT_NEAR(a(358.0, kCw), 5.0 * std::exp(-1.0), kRounding_um);
  EXPECT_NEAR(a(-2.0, kCw), 5.0 * std::exp(-1.0), kRounding_um);
  EXPECT_NEAR(a(178.0, kCw), 3.0 * std::exp(-1.0), kRounding_um);
  const auto b = [](double angle_deg, double direction) {
    return added_um("reversal_spike_b", {5.0, 3.0, 2.0}, {.angle_deg = angle_deg, .direction = direction});
  };
  EXPECT_NEAR(b(92.0, kCcw), 5.0 * std::exp(-1.0), kRounding_um);
  EXPECT_NEAR(b(272.0, kCcw), 3.0 * std::exp(-1.0), kRounding_um);
  EXPECT_NEAR(b(88.0, kCw), 5.0 * std::exp(-1.0), kRounding_um);
  EXPECT_NEAR(b(268.0, kCw), 3.0 * std::exp(-1.0), kRounding_um);
}

// CCW at 90 deg A travels towards -A: 4 um of sideways play put its slide 2 um towards -B, and the bar reads that.
TEST(lateral_play, moves_the_other_axis_by_the_sign_of_the_velocity) {
  EXPECT_NEAR(added_um("lateral_play_a", {4.0, 4.0}, {.angle_deg = 90.0}), -2.0, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_a", {4.0, 4.0}, {.angle_deg = 270.0}), -2.0, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_a", {4.0, 4.0}, {.angle_deg = 90.0, .direction = kCw}), 2.0, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_a", {4.0, 4.0}, {.angle_deg = 0.0}), 0.0, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_b", {4.0, 4.0}, {.angle_deg = 0.0}), 2.0, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_b", {4.0, 4.0}, {.angle_deg = 180.0}), 2.0, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_b", {4.0, 4.0}, {.angle_deg = 180.0, .direction = kCw}), -2.0, kRounding_um);
}

// 6 um at the + end of A and 2 um at its - end; at 60 deg CCW the slide is at + 1/2, 2.5 um towards -B, and B's share
// of the bar is sin 60 deg.
TEST(lateral_play, goes_linearly_from_one_end_to_the_other) {
  const double share = std::sqrt(0.75);
  EXPECT_NEAR(added_um("lateral_play_a", {6.0, 2.0}, {.angle_deg = 60.0}), -2.5 * share, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_a", {6.0, 2.0}, {.angle_deg = 120.0}), -1.5 * share, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_a", {6.0, 2.0}, {.angle_deg = 240.0}), -1.5 * share, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_b", {6.0, 2.0}, {.angle_deg = 30.0}), 2.5 * share, kRounding_um);
  EXPECT_NEAR(added_um("lateral_play_b", {6.0, 2.0}, {.angle_deg = -30.0, .direction = kCw}), -1.5 * share,
              kRounding_um);
}

}  // namespace
}  // namespace ballbar
