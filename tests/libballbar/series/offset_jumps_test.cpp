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

std::vector<OffsetJump> jumps_of(const std::vector<double>& values, const std::vector<Column>& others = {},
                                 std::size_t pause_at = 0) {
  Series data;
  for (std::size_t i = 0; i < values.size(); ++i)
    data.time_s.push_back(60.0 * static_cast<double>(i) + (pause_at > 0 && i >= pause_at ? 2400.0 : 0.0));
  data.columns.push_back({"bed_degC", Role::structure, values, {}});
  data.columns.insert(data.columns.end(), others.begin(), others.end());
  return offset_jumps(data, data.columns.front());
}

// That jumps by -0.9 at row 170.
std::vector<double> calibrated() {
  std::vector<double> values = body();
  for (std::size_t i = 170; i < values.size(); ++i) values[i] -= 0.9;
  return values;
}

TEST(offset_jumps, a_body_has_none) { EXPECT_TRUE(jumps_of(body()).empty()); }

TEST(offset_jumps, the_row_and_the_size_are_found) {
  const std::vector<OffsetJump> jumps = jumps_of(calibrated());
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].row, 170U);
  EXPECT_NEAR(jumps[0].size, -0.9, 0.05);
}

// The machine cools down while the logger is off.
TEST(offset_jumps, a_pause_is_none) { EXPECT_TRUE(jumps_of(calibrated(), {}, 170).empty()); }

// Something happened to the machine: its speed changed just before, or the probe jumps with it.
TEST(offset_jumps, what_other_columns_show_is_none) {
  const std::vector<double> values = calibrated();
  std::vector<double> speed(values.size(), 0.0), z(values.size(), 0.0), still(values.size(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    speed[i] = i < 167 ? 3000.0 : 6000.0;
    still[i] = 0.1 * std::sin(static_cast<double>(7 * i));
    z[i] = still[i] + (i < 170 ? 0.0 : -5.0);
  }
  EXPECT_TRUE(jumps_of(values, {{"speed_rpm", Role::speed, speed, {}}}).empty());
  EXPECT_TRUE(jumps_of(values, {{"z_um", Role::measured, z, {}}}).empty());
  EXPECT_EQ(jumps_of(values, {{"z_um", Role::measured, still, {}}}).size(), 1U);
}

// A single reading comes back.
TEST(offset_jumps, a_spike_is_none) {
  std::vector<double> values = body();
  values[170] += 5.0;
  EXPECT_TRUE(jumps_of(values).empty());
}

// The next step of the resolution, at rest, beside a value off the grid.
TEST(offset_jumps, a_step_of_the_resolution_is_none) {
  std::vector<double> values(200, 20.1);
  for (std::size_t i = 90; i < values.size(); ++i) values[i] = 20.2;
  for (std::size_t i = 150; i < values.size(); ++i) values[i] = 20.3;
  values[40] = 20.13;
  EXPECT_TRUE(jumps_of(values).empty());
}

TEST(offset_jumps, a_column_that_jumps_often_has_none) {
  std::vector<double> values = body(400);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 3.0 * static_cast<double>(i / 100);
  EXPECT_TRUE(jumps_of(values).empty());
}

TEST(offset_jumps, a_short_column_has_none) { EXPECT_TRUE(jumps_of({1.0, 2.0, 9.0}).empty()); }

}  // namespace
}  // namespace ballbar
