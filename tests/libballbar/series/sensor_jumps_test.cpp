#include "ballbar/internal/series/sensor_jumps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <utility>
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

constexpr double kPause_s = 2400.0;

std::shared_ptr<const Series> log_of(const std::vector<double>& values, const std::vector<Column>& others = {},
                                     std::size_t pause_at = 0) {
  Series data;
  for (std::size_t i = 0; i < values.size(); ++i)
    data.time_s.push_back(60.0 * static_cast<double>(i) + (pause_at > 0 && i >= pause_at ? kPause_s : 0.0));
  data.columns.push_back({"bed_degC", Role::structure, values, {}});
  data.columns.insert(data.columns.end(), others.begin(), others.end());
  return std::make_shared<const Series>(std::move(data));
}

std::vector<SensorJump> jumps_of(const std::vector<double>& values, const std::vector<Column>& others = {},
                                 std::size_t pause_at = 0) {
  return without_sensor_jumps(log_of(values, others, pause_at))->sensor_jumps;
}

// That jumps by -0.9 at row 170.
std::vector<double> calibrated() {
  std::vector<double> values = body();
  for (std::size_t i = 170; i < values.size(); ++i) values[i] -= 0.9;
  return values;
}

TEST(SensorJumps, a_body_has_none) { EXPECT_TRUE(jumps_of(body()).empty()); }

TEST(SensorJumps, is_taken_out_and_listed) {
  const std::shared_ptr<const Series> mended = without_sensor_jumps(log_of(calibrated()));
  ASSERT_EQ(mended->sensor_jumps.size(), 1U);
  EXPECT_EQ(mended->sensor_jumps[0].column, "bed_degC");
  EXPECT_EQ(mended->sensor_jumps[0].run, "");
  EXPECT_EQ(mended->sensor_jumps[0].time_s, 170.0 * 60.0);
  EXPECT_NEAR(mended->sensor_jumps[0].size, -0.9, 0.05);
  const std::vector<double> truth = body();
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(mended->columns[0].values[i], truth[i], 0.05) << i;
}

// Data without a jump are not copied.
TEST(SensorJumps, data_without_one_are_as_they_are) {
  const std::shared_ptr<const Series> data = log_of(body());
  EXPECT_EQ(without_sensor_jumps(data), data);
}

// Each run has its own, and stacked it is that of its run, in the time of the run.
TEST(SensorJumps, each_run_has_its_own) {
  const auto first = without_sensor_jumps(log_of(body()));
  Series later = *log_of(calibrated());
  for (double& time_s : later.time_s) time_s += 7.0;
  for (double& value : later.columns[0].values) value += 0.01;
  const auto second = without_sensor_jumps(std::make_shared<const Series>(later));
  const Series all = stacked({*first, *second}, {"monday", "tuesday"}).series;
  ASSERT_EQ(all.sensor_jumps.size(), 1U);
  EXPECT_EQ(all.sensor_jumps[0].run, "tuesday");
  EXPECT_EQ(all.sensor_jumps[0].time_s, 170.0 * 60.0);
  Series raw = stacked({*log_of(body()), later}, {"monday", "tuesday"}).series;
  const auto mended = without_sensor_jumps(std::make_shared<const Series>(raw));
  ASSERT_EQ(mended->sensor_jumps.size(), 1U);
  EXPECT_EQ(mended->sensor_jumps[0].run, "tuesday");
  EXPECT_EQ(mended->columns[0].values.front(), raw.columns[0].values.front());
}

// Air may jump, and a logger that holds its values for some rows makes jumps of its own.
TEST(SensorJumps, air_and_held_values_have_none) {
  Series air = *log_of(calibrated());
  air.columns[0].role = Role::ambient;
  EXPECT_TRUE(without_sensor_jumps(std::make_shared<const Series>(air))->sensor_jumps.empty());
  std::vector<double> held = calibrated();
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = held[i - i % 5];
  EXPECT_TRUE(jumps_of(held).empty());
}

// The machine cools down while the logger is off.
TEST(SensorJumps, a_pause_is_none) { EXPECT_TRUE(jumps_of(calibrated(), {}, 170).empty()); }

// Something happened to the machine: its speed changed just before, or the probe jumps with it.
TEST(SensorJumps, what_other_columns_show_is_none) {
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
TEST(SensorJumps, a_spike_is_none) {
  std::vector<double> values = body();
  values[170] += 5.0;
  EXPECT_TRUE(jumps_of(values).empty());
}

// The next step of the resolution, at rest, beside a value off the grid.
TEST(SensorJumps, a_step_of_the_resolution_is_none) {
  std::vector<double> values(200, 20.1);
  for (std::size_t i = 90; i < values.size(); ++i) values[i] = 20.2;
  for (std::size_t i = 150; i < values.size(); ++i) values[i] = 20.3;
  values[40] = 20.13;
  EXPECT_TRUE(jumps_of(values).empty());
}

TEST(SensorJumps, a_column_that_jumps_often_has_none) {
  std::vector<double> values = body(400);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 3.0 * static_cast<double>(i / 100);
  EXPECT_TRUE(jumps_of(values).empty());
}

TEST(SensorJumps, a_short_column_has_none) { EXPECT_TRUE(jumps_of({1.0, 2.0, 9.0}).empty()); }

}  // namespace
}  // namespace ballbar
