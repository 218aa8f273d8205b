// Play at a joint and a clock that is off, worked by hand.
#include <gtest/gtest.h>

#include "drift_values.hpp"

namespace ballbar {
namespace {

void expect_near(const std::vector<double>& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-12) << "row " << i;
}

// u since the start 0, 3, 2.5, 1, 0.5, -2 with half width 1. The follower stays within u - 1 and u + 1:
// 0; [2, 4] pulls it to 2; [1.5, 3.5] and [0, 2] leave it; [-0.5, 1.5] pulls it to 1.5; [-3, -1] to -1.
// follower - u = 0, -1, -0.5, 1, 1, 1. By the half width: only where it is pulled along, -1 upwards and 1 downwards;
// where it sticks at 2 = u_1 - w still -1.
TEST(PlayHysteresis, SticksAndSlips) {
  const std::vector<double> u{20, 23, 22.5, 21, 20.5, 18};
  const DriftValues held = drift_values("play_hysteresis", {0, 1, 10, 11, 50, 90}, {u}, {2.0, 1.0});
  expect_near(held.values, {0.0, -2.0, -1.0, 2.0, 2.0, 2.0});
  expect_near(held.derivatives, {0.0, 0.0, -1.0, -2.0, -0.5, -2.0, 1.0, -2.0, 1.0, 2.0, 1.0, 2.0});
}

TEST(PlayHysteresis, DoesNotDependOnTheRate) {
  const std::vector<double> u{20, 23, 22.5, 21, 20.5, 18};
  EXPECT_EQ(drift_values("play_hysteresis", {0, 1, 10, 11, 50, 90}, {u}, {2.0, 0.7}).values,
            drift_values("play_hysteresis", {0, 100, 101, 200, 300, 1000}, {u}, {2.0, 0.7}).values);
}

// u = 0, 10, 10, 30 at 0, 100, 300, 400 s. 50 s late: u(-50) = 0 (held), u(50) = 5, u(250) = 10, u(350) = 20, so
// u(t - 50) - u = 0, -5, 0, -10; by the offset it falls with the slope there: 0, 0.1, 0, 0.2 um/s.
TEST(ClockOffset, MovesTheSignalToLater) {
  const DriftValues late = drift_values("clock_offset", {0, 100, 300, 400}, {{0, 10, 10, 30}}, {3.0, 50.0});
  expect_near(late.values, {0.0, -15.0, 0.0, -30.0});
  expect_near(late.derivatives, {0.0, 0.0, -5.0, -0.3, 0.0, 0.0, -10.0, -0.6});
}

// 50 s early: u(50) = 5, u(150) = 10, u(350) = 20, u(450) = 30 (held).
TEST(ClockOffset, MovesTheSignalToEarlier) {
  expect_near(drift_values("clock_offset", {0, 100, 300, 400}, {{0, 10, 10, 30}}, {3.0, -50.0}).values,
              {15.0, 0.0, 30.0, 0.0});
}

TEST(ClockOffset, HoldsTheEndsBeyondTheWholeRecord) {
  expect_near(drift_values("clock_offset", {0, 100}, {{4, 10}}, {1.0, 7200.0}).values, {0.0, -6.0});
  expect_near(drift_values("clock_offset", {0, 100}, {{4, 10}}, {1.0, -7200.0}).values, {6.0, 0.0});
  expect_near(drift_values("clock_offset", {7}, {{4}}, {1.0, 60.0}).values, {0.0});
}

}  // namespace
}  // namespace ballbar
