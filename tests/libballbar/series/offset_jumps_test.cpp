#include "series/offset_jumps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace ballbar {
namespace {

// A body that warms up and cools down with a time constant of 20 rows, noise 0.02, resolution 0.01.
std::vector<double> body(std::size_t n = 300) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  double now = 20.0;
  for (std::size_t i = 0; i < n; ++i) {
    now += ((i / 60) % 2 == 1 ? 40.0 - now : 20.0 - now) / 20.0;
    values.push_back(std::round(100.0 * (now + 0.02 * normal(random))) / 100.0);
  }
  return values;
}

TEST(offset_jumps, a_body_has_none) { EXPECT_TRUE(offset_jumps(body()).empty()); }

TEST(offset_jumps, the_row_and_the_size_are_found) {
  std::vector<double> values = body();
  for (std::size_t i = 170; i < values.size(); ++i) values[i] -= 0.9;
  const std::vector<OffsetJump> jumps = offset_jumps(values);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].row, 170U);
  EXPECT_NEAR(jumps[0].size, -0.9, 0.05);
}

// A single reading comes back.
TEST(offset_jumps, a_spike_is_none) {
  std::vector<double> values = body();
  values[170] += 5.0;
  EXPECT_TRUE(offset_jumps(values).empty());
}

// The next step of the resolution, at rest.
TEST(offset_jumps, a_step_of_the_resolution_is_none) {
  std::vector<double> values(200, 20.1);
  for (std::size_t i = 90; i < values.size(); ++i) values[i] = 20.2;
  for (std::size_t i = 150; i < values.size(); ++i) values[i] = 20.3;
  EXPECT_TRUE(offset_jumps(values).empty());
}

TEST(offset_jumps, a_column_that_jumps_often_has_none) {
  std::vector<double> values = body(400);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 3.0 * static_cast<double>(i / 100);
  EXPECT_TRUE(offset_jumps(values).empty());
}

TEST(offset_jumps, a_short_column_has_none) { EXPECT_TRUE(offset_jumps({1.0, 2.0, 9.0}).empty()); }

}  // namespace
}  // namespace ballbar
