#include "ballbar/internal/series/clock_lag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ballbar/internal/series/zone_shift.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

// A programme of speeds, each held for some minutes.
double speed_at(double time_s) {
  constexpr double kLevels_rpm[] = {0, 6000, 2000, 12000, 4000, 9000, 0, 15000, 3000};
  constexpr double kHeld_s[] = {300, 420, 240, 600, 360, 500, 280, 450, 10000};
  for (std::size_t i = 0; i < std::size(kHeld_s); ++i) {
    if (time_s < kHeld_s[i]) return kLevels_rpm[i];
    time_s -= kHeld_s[i];
  }
  return 0.0;
}

Series logged(double step_s, double late_s, double noise, unsigned seed, Role role, const char* name) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  Series series;
  Column column{name, role, {}};
  for (double t = 0.0; t < 3600.0; t += step_s) {
    series.time_s.push_back(t);
    column.values.push_back(speed_at(t + late_s) * (role == Role::load ? 0.003 : 1.0) + noise * normal(engine));
  }
  series.columns.push_back(column);
  return series;
}

TEST(clock_lag, is_found_between_a_speed_and_a_load_within_its_sigma) {
  int outside = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const double lag_s = -100.0 + 11.0 * seed;
    const Series first = logged(1.0, 0.0, 20.0, seed, Role::speed, "n_rpm");
    const Series second = logged(5.0, lag_s, 0.5, seed + 100, Role::load, "load_percent");
    const auto found = clock_lag(first, second, 600.0);
    ASSERT_TRUE(found) << seed;
    EXPECT_EQ(found->column, "n_rpm");
    EXPECT_LT(found->sigma_s, 5.0);
    outside += std::abs(found->lag_s - lag_s) > 3.0 * found->sigma_s;
  }
  EXPECT_LE(outside, 1);
}

TEST(clock_lag, is_not_told_where_nothing_is_shared) {
  const Series first = logged(1.0, 0.0, 20.0, 1, Role::speed, "n_rpm");
  Series room = logged(5.0, 0.0, 0.0, 2, Role::ambient, "room_degC");
  EXPECT_FALSE(clock_lag(first, room, 600.0));
  // A speed that has nothing to do with the first.
  Series other = logged(1.0, 0.0, 20.0, 3, Role::speed, "n2_rpm");
  std::mt19937 engine(4);
  for (double& value : other.columns.front().values) value = static_cast<double>(engine() % 1000);
  EXPECT_FALSE(clock_lag(first, other, 600.0));
}

TEST(clock_lag, a_programme_that_repeats_is_not_told) {
  Series first, second;
  Column a{"n_rpm", Role::speed, {}}, b{"m_rpm", Role::speed, {}};
  for (double t = 0.0; t < 3600.0; t += 2.0) {
    first.time_s.push_back(t);
    second.time_s.push_back(t);
    a.values.push_back(std::fmod(t, 600.0) < 300.0 ? 1000.0 : 0.0);
    b.values.push_back(std::fmod(t + 40.0, 600.0) < 300.0 ? 1000.0 : 0.0);
  }
  first.columns.push_back(a);
  second.columns.push_back(b);
  EXPECT_FALSE(clock_lag(first, second, 1500.0));
  const auto near = clock_lag(first, second, 200.0);  // within half its period there is one
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->lag_s, 40.0, 2.0);
}

TEST(column_faults, of_what_looks_broken) {
  Series series;
  Column still{"a_degC", Role::structure, {}}, stuck{"b_degC", Role::structure, {}}, spiked{"c_um", Role::measured, {}},
      speed{"n_rpm", Role::speed, {}};
  for (int i = 0; i < 400; ++i) {
    series.time_s.push_back(i < 200 ? i : i + 100.0);
    still.values.push_back(21.5);
    stuck.values.push_back(i < 300 ? 20.0 + 0.01 * i : 23.0);
    spiked.values.push_back(std::sin(0.05 * i) + (i == 77 ? 50.0 : 0.0));
    speed.values.push_back(i < 100 ? 0.0 : 3000.0);
  }
  series.columns = {still, stuck, spiked, speed};
  const std::vector<ColumnFault> faults = column_faults(series);
  ASSERT_EQ(faults.size(), 4u);
  EXPECT_EQ(faults[0].kind, FaultKind::pauses);
  EXPECT_EQ(faults[0].count, 1u);
  EXPECT_EQ(faults[0].value, 101.0);
  EXPECT_EQ(faults[0].at_s, 199.0);
  EXPECT_EQ(faults[1].kind, FaultKind::constant);
  EXPECT_EQ(faults[1].value, 21.5);
  EXPECT_EQ(faults[2].kind, FaultKind::stuck);
  EXPECT_EQ(faults[2].count, 100u);
  EXPECT_EQ(faults[2].value, 23.0);
  EXPECT_EQ(faults[3].kind, FaultKind::far_off);
  EXPECT_EQ(faults[3].column, "c_um");
  EXPECT_EQ(faults[3].at_s, 77.0);
  ASSERT_EQ(faults_bearing_on(series, "c_um").size(), 2u);  // neither the pause nor the constant
  EXPECT_EQ(faults_bearing_on(series, "d_um").size(), 1u);
}

// A sensor that ends at 30 degC, and a probe that the control moves by 2 um every 100 rows; a speed jumps by nature.
TEST(column_faults, of_sensors_that_are_clipped_and_probes_that_jump) {
  Series series;
  std::mt19937 engine(1);
  std::normal_distribution<double> normal(0.0, 0.1);
  Column clipped{"a_degC", Role::structure, {}}, free{"b_degC", Role::structure, {}}, moved{"c_um", Role::measured, {}},
      speed{"n_rpm", Role::speed, {}};
  for (int i = 0; i < 600; ++i) {
    series.time_s.push_back(60.0 * i);
    const double degC = 25.0 + 8.0 * std::sin(0.02 * i);
    clipped.values.push_back(std::min(30.0, std::round(100.0 * degC) / 100.0));
    free.values.push_back(std::round(100.0 * degC) / 100.0);
    moved.values.push_back(2.0 * (i / 100 % 2) + 0.001 * i + normal(engine));
    speed.values.push_back((i + 25) / 50 % 2 * 6000.0);
  }
  series.columns = {clipped, free, moved, speed};
  const std::vector<ColumnFault> faults = column_faults(series);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].kind, FaultKind::clipped);
  EXPECT_EQ(faults[0].column, "a_degC");
  EXPECT_EQ(faults[0].value, 30.0);
  EXPECT_NEAR(static_cast<double>(faults[0].count), 600.0 * 0.27, 30.0);  // sin > 5/8 in 51.3 deg/180 of the time
  EXPECT_FALSE(faults[0].is_low);
  EXPECT_EQ(faults[1].kind, FaultKind::jumps);
  EXPECT_EQ(faults[1].count, 5u);
  EXPECT_NEAR(faults[1].value, 2.0, 0.15);
  EXPECT_EQ(faults[1].at_s, 6000.0);
}

// One day of a bearing that warms up and cools down at odd times, in a room whose heating switches; or of the room, as
// a logger has it whose clock is `behind_s` behind.
Series of_a_hall(double step_s, double behind_s, bool is_room, double noise_K, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, noise_K);
  Series series;
  Column column{is_room ? "Room_degC" : "bearing_degC", is_room ? Role::ambient : Role::bearing, {}};
  std::mt19937 events(5);
  bool heats = false, turns = false;
  double room = 18.0, bearing = 18.0;
  for (int t = 0; t < 86400; t += 60) {
    heats = heats != (events() % 100 < 3);
    turns = turns != (events() % 100 < 2);
    room += ((heats ? 24.0 : 17.0) - room) * 60.0 / 1500.0;
    bearing += (room + (turns ? 1.0 : 0.0) - bearing) * 60.0 / 180.0;
    if (t % static_cast<int>(step_s) != 0) continue;
    series.time_s.push_back(t - behind_s);
    column.values.push_back(std::round(10.0 * ((is_room ? room : bearing) + normal(engine))) / 10.0);
  }
  series.columns.push_back(column);
  return series;
}

TEST(zone_shift, is_found_from_temperatures_that_change_together) {
  const Series bearing = of_a_hall(60.0, 0.0, false, 0.05, 1);
  for (const double shift_h : {6.0, -1.0, 1.0, -8.0, 5.5}) {
    const auto found = zone_shift(bearing, of_a_hall(300.0, 3600.0 * shift_h, true, 0.05, 2));
    ASSERT_TRUE(found) << shift_h;
    EXPECT_EQ(found->shift_s, 3600.0 * shift_h);
    EXPECT_EQ(found->column, "bearing_degC");
    EXPECT_EQ(found->other, "Room_degC");
    EXPECT_GT(found->correlation, found->correlation_now);
  }
  EXPECT_FALSE(zone_shift(bearing, of_a_hall(300.0, 0.0, true, 0.05, 2)));  // they agree as they are
}

TEST(zone_shift, is_none_of_curves_that_are_alike_at_many_shifts) {
  Series day, other, noise;
  std::mt19937 engine(3);
  std::normal_distribution<double> normal(0.0, 0.1);
  day.columns = {{"a_degC", Role::structure, {}}};
  other.columns = {{"b_degC", Role::ambient, {}}};
  noise.columns = {{"c_degC", Role::ambient, {}}};
  for (int i = 0; i < 288; ++i) {
    for (Series* series : {&day, &other, &noise}) series->time_s.push_back(300.0 * i);
    day.columns[0].values.push_back(20.0 + 2.0 * std::sin(0.0218 * i));
    other.columns[0].values.push_back(21.0 + 3.0 * std::sin(0.0218 * (i + 40)));
    noise.columns[0].values.push_back(20.0 + normal(engine));
  }
  EXPECT_FALSE(zone_shift(day, other));
  EXPECT_FALSE(zone_shift(day, noise));
}

}  // namespace
}  // namespace ballbar
