#include "ballbar/series/clock_lag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ballbar/series/column_faults.hpp"

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
  EXPECT_EQ(faults[0].what, "1 pause of more than 10 s, the longest of 101 s at 199 s");
  EXPECT_EQ(faults[1].what, "does not change: 21.5 in all rows");
  EXPECT_EQ(faults[2].what, "does not change any more in the last 100 rows: 23");
  EXPECT_EQ(faults[3].column, "c_um");
}

}  // namespace
}  // namespace ballbar
