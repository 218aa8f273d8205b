#include "ballbar/internal/series/speed_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

std::vector<SpeedStep> steps_of(const std::vector<double>& rpm, double interval_s) {
  std::vector<double> time_s;
  for (std::size_t row = 0; row < rpm.size(); ++row) time_s.push_back(static_cast<double>(row) * interval_s);
  return speed_steps(time_s, {"n_rpm", Role::speed, rpm});
}

void expect_steps(const std::vector<SpeedStep>& steps, const std::vector<SpeedStep>& expected) {
  ASSERT_EQ(steps.size(), expected.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].speed_rpm, expected[i].speed_rpm) << "step " << i;
    EXPECT_EQ(steps[i].begin, expected[i].begin) << "step " << i;
    EXPECT_EQ(steps[i].end, expected[i].end) << "step " << i;
  }
}

TEST(speed_steps, constant) {
  expect_steps(steps_of({3000, 3000, 3000}, 60.0), {{3000.0, 0, 3}});
  expect_steps(steps_of({0, 0, 0}, 60.0), {{0.0, 0, 3}});
}

TEST(speed_steps, stops_and_starts) {
  expect_steps(steps_of({3000, 3000, 0, 0, 5000, 5000}, 60.0), {{3000.0, 0, 2}, {0.0, 2, 4}, {5000.0, 4, 6}});
}

// 10 s a row: the ramp of 30 s from 0 to 4000 joins what comes after it, the way down the standstill.
TEST(speed_steps, a_ramp_joins_what_comes_after_it) {
  expect_steps(steps_of({0,    0,    0,    0,    0,    0,    0,    1000, 2000, 3000, 4000, 4000,
                         4000, 4000, 4000, 4000, 4000, 4000, 2000, 0,    0,    0,    0,    0},
                        10.0),
               {{0.0, 0, 7}, {4000.0, 7, 18}, {0.0, 18, 24}});
  // It begins with the ramp.
  expect_steps(steps_of({0, 2000, 4000, 4000, 4000, 4000, 4000, 4000}, 10.0), {{4000.0, 0, 8}});
}

// Just 60 s are a step: 6 rows of 10 s; 5 rows are not.
TEST(speed_steps, shorter_than_60_s_is_no_step) {
  expect_steps(steps_of({100, 100, 100, 100, 100, 100, 200, 200, 200, 200, 200, 200, 300, 300}, 10.0),
               {{100.0, 0, 6}, {200.0, 6, 12}, {300.0, 12, 14}});
  expect_steps(steps_of({100, 100, 100, 100, 100, 100, 200, 200, 200, 200, 200, 300, 300, 300, 300, 300, 300}, 10.0),
               {{100.0, 0, 6}, {300.0, 6, 17}});
}

// One row of 10 s at 500 rpm, or five, within a constant stretch; six are a step. What comes after is found all the
// same.
TEST(speed_steps, a_stray_row_splits_nothing) {
  for (const std::size_t stray : {1U, 5U, 6U}) {
    std::vector<double> rpm(30, 3000.0);
    std::fill_n(rpm.begin() + 10, stray, 500.0);
    rpm[20] = 3050.0;  // within 2 %
    if (stray < 6) {
      expect_steps(steps_of(rpm, 10.0), {{3000.0, 0, 30}});
    } else {
      expect_steps(steps_of(rpm, 10.0), {{3000.0, 0, 10}, {500.0, 10, 16}, {3000.0, 16, 30}});
    }
  }
  // 3000 for 20 s after the stray row, then 5000.
  std::vector<double> rpm(40, 5000.0);
  std::fill_n(rpm.begin(), 13, 3000.0);
  rpm[10] = 500.0;
  expect_steps(steps_of(rpm, 10.0), {{3000.0, 0, 13}, {5000.0, 13, 40}});
}

// 2 % of the largest speed, 5000: 100 rpm, at any speed.
TEST(speed_steps, two_percent_of_the_largest_speed) {
  expect_steps(steps_of({5000, 5000, 1000, 1100, 1000}, 60.0), {{5000.0, 0, 2}, {1000.0, 2, 5}});
  expect_steps(steps_of({5000, 5000, 1000, 1101, 1101}, 60.0), {{5000.0, 0, 2}, {1000.0, 2, 3}, {1101.0, 3, 5}});
  expect_steps(steps_of({-5000, -5000, 1000, 1090}, 60.0), {{-5000.0, 0, 2}, {1090.0, 2, 4}});
}

TEST(speed_steps, a_row_without_speed_continues_its_step) {
  expect_steps(steps_of({3000, kGap, 3000, kGap, 0, 0, kGap}, 60.0), {{3000.0, 0, 4}, {0.0, 4, 7}});
  expect_steps(steps_of({kGap, kGap, 3000, 3000, 0}, 60.0), {{3000.0, 0, 4}, {0.0, 4, 5}});
  const std::vector<SpeedStep> unknown = steps_of({kGap, kGap}, 60.0);
  ASSERT_EQ(unknown.size(), 1U);
  EXPECT_TRUE(std::isnan(unknown[0].speed_rpm));
  EXPECT_EQ(unknown[0].end, 2U);
}

// A display that jumps by 10 rpm (one sigma) about 3000 and 2000 rpm: 2 % are 60 rpm, six sigma.
TEST(speed_steps, noise_in_the_speed) {
  std::mt19937_64 random = simulation::stream_of(1, simulation::Stream::signal, simulation::key_of("speed_steps"));
  std::vector<double> rpm;
  for (std::size_t row = 0; row < 2000; ++row) {
    // Cut at 2.5 sigma, so that no two readings of a step are 60 rpm apart.
    const double noise = std::clamp(simulation::normal(random), -2.5, 2.5);
    rpm.push_back((row < 1200 ? 3000.0 : 2000.0) + 10.0 * noise);
  }
  const std::vector<SpeedStep> steps = steps_of(rpm, 1.0);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].end, 1200U);
  EXPECT_NEAR(steps[0].speed_rpm, 3000.0, 2.0);  // rpm: 5 sigma of a median of 1200
  EXPECT_NEAR(steps[1].speed_rpm, 2000.0, 2.5);
}

TEST(speed_steps, a_single_row_and_none) {
  expect_steps(steps_of({3000}, 60.0), {{3000.0, 0, 1}});
  EXPECT_TRUE(steps_of({}, 60.0).empty());
}

}  // namespace
}  // namespace ballbar
