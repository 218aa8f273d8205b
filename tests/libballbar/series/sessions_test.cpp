#include "ballbar/internal/series/sessions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ballbar {
namespace {

// Two days of 60 readings a minute apart, 14 h between them. Each begins at 0 and rises to 30 um.
Series two_days() {
  Series data;
  Column z{"z_um", Role::measured, {}, {}};
  for (std::size_t i = 0; i < 120; ++i) {
    const double minute = static_cast<double>(i % 60), sign = i % 2 == 0 ? 1.0 : -1.0;
    data.time_s.push_back(60.0 * minute + (i < 60 ? 0.0 : 15.0 * 3600.0));
    z.values.push_back(30.0 * (1.0 - std::exp(-minute / 20.0)) + (i % 60 == 0 ? 0.0 : 0.2 * sign));
  }
  data.columns.push_back(z);
  return data;
}

TEST(sessions_of, probes_that_begin_at_zero_again_begin_a_session) {
  const std::vector<RowRange> sessions = sessions_of(two_days(), {"z_um"});
  ASSERT_EQ(sessions.size(), 2U);
  EXPECT_EQ(sessions[0].end, 60U);
  EXPECT_EQ(sessions[1].begin, 60U);
  EXPECT_EQ(sessions[1].end, 120U);
}

TEST(sessions_of, a_probe_that_goes_on_is_one_session) {
  Series data = two_days();
  for (std::size_t i = 60; i < 120; ++i) data.columns[0].values[i] += 12.0;
  EXPECT_TRUE(sessions_of(data, {"z_um"}).empty());
}

// A probe that is near zero may be there by itself when the machine has cooled for a while.
TEST(sessions_of, a_short_pause_begins_one_where_the_probe_was_far_from_zero) {
  Series data = two_days();
  for (std::size_t i = 60; i < 120; ++i) data.time_s[i] -= 13.0 * 3600.0;
  EXPECT_EQ(sessions_of(data, {"z_um"}).size(), 2U);
  for (std::size_t i = 0; i < 60; ++i) data.columns[0].values[i] -= 24.0;  // ends at 4 um
  EXPECT_TRUE(sessions_of(data, {"z_um"}).empty());
  for (std::size_t i = 60; i < 120; ++i) data.time_s[i] += 13.0 * 3600.0;
  EXPECT_EQ(sessions_of(data, {"z_um"}).size(), 2U);
}

TEST(sessions_of, a_stop_of_a_quarter_of_an_hour_begins_none) {
  Series data = two_days();
  for (std::size_t i = 60; i < 120; ++i) data.time_s[i] -= 13.75 * 3600.0;
  EXPECT_TRUE(sessions_of(data, {"z_um"}).empty());
}

// All probes are set to zero, or none.
TEST(sessions_of, another_probe_that_goes_on_makes_it_one) {
  Series data = two_days();
  Column x = data.columns[0];
  x.name = "x_um";
  for (std::size_t i = 60; i < 120; ++i) x.values[i] += 12.0;
  data.columns.push_back(x);
  EXPECT_TRUE(sessions_of(data, {"z_um", "x_um"}).empty());
}

TEST(sessions_of, a_few_rows_are_none) {
  Series data = two_days();
  data.time_s.resize(63);
  data.columns[0].values.resize(63);
  EXPECT_TRUE(sessions_of(data, {"z_um"}).empty());
}

TEST(sessions_of, a_probe_may_be_set_to_another_value) {
  Series data = two_days();
  for (std::size_t i = 60; i < 120; ++i) data.columns[0].values[i] += 300.0;
  EXPECT_EQ(sessions_of(data, {"z_um"}).size(), 2U);
  for (double& value : data.columns[0].values) value += 12.0;  // 12 and 312 on the two days: it moved
  EXPECT_TRUE(sessions_of(data, {"z_um"}).empty());
  for (std::size_t i = 60; i < 120; ++i) data.columns[0].values[i] -= 300.0;  // 12 on both
  EXPECT_EQ(sessions_of(data, {"z_um"}).size(), 2U);
}

// The probe was set to zero on the second day alone.
TEST(sessions_of, the_first_may_begin_elsewhere) {
  Series data = two_days();
  for (std::size_t i = 0; i < 60; ++i) data.columns[0].values[i] += 12.0;
  EXPECT_EQ(sessions_of(data, {"z_um"}).size(), 2U);
}

// The noise of the readings does not make -3 um a zero.
TEST(sessions_of, a_value_beyond_the_noise_is_no_zero) {
  Series data = two_days();
  for (std::size_t i = 60; i < 120; ++i) data.columns[0].values[i] -= 3.0;
  EXPECT_TRUE(sessions_of(data, {"z_um"}).empty());
}

TEST(sessions_of, without_a_target_or_rows_there_is_none) {
  EXPECT_TRUE(sessions_of(two_days(), {}).empty());
  EXPECT_TRUE(sessions_of(Series{}, {}).empty());
}

}  // namespace
}  // namespace ballbar
