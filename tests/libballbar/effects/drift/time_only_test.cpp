// Effects that need nothing but time, worked by hand. Rows start at 1000 s: only the onset is a time of the data.
#include <gtest/gtest.h>

#include <numbers>

#include "drift_values.hpp"

namespace ballbar {
namespace {

void expect_near(const std::vector<double>& values, const std::vector<double>& expected, double tolerance_um = 1e-12) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance_um) << "row " << i;
}

// Period 400 s: a quarter after 100 s, a half after 200 s; an eighth after 50 s gives (3 + 4) / sqrt 2.
TEST(ThermostatCycle, GoesRoundInAPeriod) {
  expect_near(drift_values("thermostat_cycle", {1000, 1050, 1100, 1200}, {}, {3.0, 4.0, 400.0}).values,
              {3.0, 7.0 / std::numbers::sqrt2, 4.0, -3.0});
}

TEST(DayCycle, GoesRoundInADay) {
  expect_near(drift_values("day_cycle", {1000, 22600, 44200}, {}, {3.0, 4.0, 86400.0}).values, {3.0, 4.0, -3.0});
}

// tau = 100 s / ln 2: half of it after 100 s, seven eighths after 300 s.
TEST(Settling, ComesToRest) {
  expect_near(drift_values("settling", {1000, 1100, 1300}, {}, {8.0, 100.0 / std::numbers::ln2}).values,
              {0.0, 4.0, 7.0});
}

TEST(LinearDrift, GoesWithTheHours) {
  expect_near(drift_values("linear_drift", {1000, 2800, 6400}, {}, {2.0}).values, {0.0, 1.0, 3.0});
}

// An onset on a row's time: the exact step just after that row. Its derivative is that of the ramp over the next row's
// width: -4 um / 200 s.
TEST(Step, IsExactOnARowsTime) {
  const std::vector<double> time_s{1000, 1100, 1300, 1400};
  const DriftValues on_row = drift_values("step", time_s, {}, {4.0, 1100.0});
  expect_near(on_row.values, {0.0, 0.0, 4.0, 4.0});
  expect_near(on_row.derivatives, {0.0, 0.0, 0.0, 0.0, 1.0, -0.02, 1.0, 0.0});
  expect_near(drift_values("step", time_s, {}, {4.0, 1300.0}).values, {0.0, 0.0, 0.0, 4.0});
  expect_near(drift_values("step", time_s, {}, {4.0, 1400.0}).values, {0.0, 0.0, 0.0, 0.0});
  expect_near(drift_values("step", time_s, {}, {4.0, 0.0}).values, {4.0, 4.0, 4.0, 4.0});
}

// 150 s of the 200 s before the third row lie after an onset at 1150 s.
TEST(Step, CountsARowWithItsShare) {
  const DriftValues between = drift_values("step", {1000, 1100, 1300, 1400}, {}, {4.0, 1150.0});
  expect_near(between.values, {0.0, 0.0, 3.0, 4.0});
  expect_near(between.derivatives, {0.0, 0.0, 0.0, 0.0, 0.75, -0.02, 1.0, 0.0});
  // 50 s of 200 s; the row after that lies one and a half of its widths behind the onset.
  expect_near(drift_values("step", {1000, 1100, 1300, 1400}, {}, {4.0, 1250.0}).values, {0.0, 0.0, 1.0, 4.0});
}

// A search over the rows' times finds 1100 s; from there one step of a solver ends on the onset: the third row misses
// 3 - 4 um, and moves by -0.02 um for each second.
TEST(Step, IsFoundFromTheNearestRow) {
  const DriftValues near = drift_values("step", {1000, 1100, 1300, 1400}, {}, {4.0, 1100.0});
  EXPECT_NEAR(1100.0 + (3.0 - near.values[2]) / near.derivatives[2 * 2 + 1], 1150.0, 1e-9);
}

}  // namespace
}  // namespace ballbar
