// A drift and its signals on their own clocks become one series.
#include "ballbar/series/merged_series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

Series drift() { return {{60.0, 600.0, 1500.0}, {{"x_um", Role::measured, {0.0, 3.0, 5.0}}}, std::nullopt}; }

Series signals() {
  return {{0.0, 400.0, 800.0, 1200.0},
          {{"T_degC", Role::structure, {20.0, 24.0, kGap, 28.0}},
           {"speed_rpm", Role::speed, {0.0, 8000.0, 8000.0, 0.0}},
           {"door", Role::event, {0.0, 1.0, kGap, 0.0}}},
          std::nullopt};
}

void expect_values(const Series& series, std::string_view name, const std::vector<double>& expected) {
  const Column* column = find_column(series, name);
  ASSERT_NE(column, nullptr) << name;
  ASSERT_EQ(column->values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(column->values[i])) << name << " row " << i;
    } else {
      EXPECT_NEAR(column->values[i], expected[i], 1e-12) << name << " row " << i;
    }
  }
}

// Rows at 0, 60, 400, 600, 800, 1200 s; 1500 s is outside the signals. T at 60 s: 20 + 4 * 60 / 400; at 600 s, across
// the gap at 800 s: 24 + 4 * 200 / 800; speed at 60 s: 8000 * 60 / 400.
TEST(Merged, signals_are_lines_and_measured_values_stand_where_they_are) {
  const Series series = merged({drift(), signals()}, 800.0);
  EXPECT_EQ(series.time_s, (std::vector<double>{0.0, 60.0, 400.0, 600.0, 800.0, 1200.0}));
  expect_values(series, "x_um", {kGap, 0.0, kGap, 3.0, kGap, kGap});
  expect_values(series, "T_degC", {20.0, 20.6, 24.0, 25.0, 26.0, 28.0});
  expect_values(series, "speed_rpm", {0.0, 1200.0, 8000.0, 8000.0, 8000.0, 0.0});
  expect_values(series, "door", {0.0, 0.0, 1.0, 1.0, 1.0, 0.0});
}

TEST(Merged, one_part_without_signals_is_itself) {
  const Series series = merged({drift()}, 60.0);
  EXPECT_EQ(series.time_s, drift().time_s);
  expect_values(series, "x_um", {0.0, 3.0, 5.0});
}

// A gap outside the common time is nobody's: T ends the time at 400 s, speed's long gap is after it.
TEST(Merged, gaps_outside_the_common_time_do_not_matter) {
  const Series a{{0.0, 100.0, 400.0}, {{"T_degC", Role::structure, {1.0, 2.0, 3.0}}}, std::nullopt};
  const Series b{{0.0, 400.0, 9000.0}, {{"speed_rpm", Role::speed, {1.0, 1.0, 1.0}}}, std::nullopt};
  EXPECT_EQ(merged({a, b}, 400.0).time_s, (std::vector<double>{0.0, 100.0, 400.0}));
}

// Joining in any order gives the same values; joining again changes nothing.
TEST(Merged, order_does_not_matter_and_again_changes_nothing) {
  const Series one = merged({drift(), signals()}, 800.0), other = merged({signals(), drift()}, 800.0);
  EXPECT_EQ(one.time_s, other.time_s);
  const Series again = merged({one}, 800.0);
  for (const Column& column : one.columns) {
    expect_values(other, column.name, column.values);
    expect_values(again, column.name, column.values);
  }
}

// T fails at 800 s: between 400 and 1200 s it is not known within 700 s.
TEST(Merged, a_row_within_a_long_gap_of_a_signal_is_left_out) {
  Series often = signals();
  for (Column& column : often.columns) column.values[2] = column.values[1];
  often.columns[0].values[2] = kGap;
  const Series early{{0.0, 100.0, 200.0, 300.0, 380.0, 1200.0},
                     {{"x_um", Role::measured, {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}}},
                     std::nullopt};
  const Series series = merged({early, often}, 700.0);
  EXPECT_EQ(series.time_s, (std::vector<double>{0.0, 100.0, 200.0, 300.0, 380.0, 400.0, 1200.0}));
  expect_values(series, "T_degC", {20.0, 21.0, 22.0, 23.0, 23.8, 24.0, 28.0});
  const std::vector<Series> parts{early, often};
  const std::vector<RowsWithout> without = rows_without_signal(parts, 700.0);
  ASSERT_EQ(without.size(), 1U);
  EXPECT_EQ(without[0].signal, "T_degC");
  EXPECT_EQ(without[0].rows, 1U);
  EXPECT_EQ(without[0].max_gap_s, 700.0);
}

// Read by hand every 20 min, with a pause of 3 h and the night: nothing is invented, so that nothing is missing.
TEST(Merged, a_pause_without_rows_is_no_gap) {
  const Series hand{{0.0, 1200.0, 2400.0, 13200.0, 14400.0, 72000.0},
                    {{"T_degC", Role::structure, {20.0, 21.0, 22.0, 23.0, 24.0, 20.0}},
                     {"z_um", Role::measured, {0.0, 1.0, 2.0, 3.0, 4.0, 0.0}}},
                    std::nullopt};
  const auto series = std::make_shared<const Series>(hand);
  EXPECT_EQ(with_gaps_closed(series, std::nullopt), series);
  EXPECT_EQ(merged({hand}, 60.0).time_s, hand.time_s);
}

// Of 20 min: 3 usual steps are 60 min, so that one value that failed is interpolated, and three are not.
TEST(Merged, the_usual_longest_gap_is_3_steps_of_the_signal) {
  Series hand;
  Column t{"T_degC", Role::structure, {}}, z{"z_um", Role::measured, {}};
  for (int row = 0; row < 20; ++row) {
    hand.time_s.push_back(1200.0 * row);
    t.values.push_back(20.0 + row);
    z.values.push_back(row);
  }
  t.values[3] = t.values[10] = t.values[11] = t.values[12] = kGap;
  hand.columns = {t, z};
  const Series series = merged({hand}, std::nullopt);
  EXPECT_EQ(series.time_s.size(), 17U);
  EXPECT_NEAR(series.columns[0].values[3], 23.0, 1e-12);
}

// A level of a tank is a line, a tool's number and a switch hold.
TEST(Merged, an_event_that_is_smooth_is_interpolated) {
  const Series slow{{0.0, 100.0, 200.0, 300.0},
                    {{"level", Role::event, {0.5, 1.5, 2.0, 2.4}},
                     {"tool", Role::event, {1.0, 7.0, 3.0, 5.0}},
                     {"pump", Role::event, {0.0, 0.5, 0.0, 0.5}}},
                    std::nullopt};
  const Series drift{{50.0, 150.0}, {{"x_um", Role::measured, {0.0, 1.0}}}, std::nullopt};
  const Series series = merged({drift, slow}, 600.0);
  expect_values(series, "level", {0.5, 1.0, 1.5, 1.75, 2.0, 2.4});
  expect_values(series, "tool", {1.0, 1.0, 7.0, 7.0, 3.0, 5.0});
  expect_values(series, "pump", {0.0, 0.0, 0.5, 0.5, 0.0, 0.5});
}

std::string message_of(const std::vector<Series>& parts, double max_gap_s) {
  try {
    merged(parts, max_gap_s);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Where it throws for gaps: the longest of all signals, with which it keeps all rows.
TEST(Merged, the_longest_gap_is_known_where_too_many_rows_are_in_gaps) {
  Series log;
  Column t{"T_degC", Role::structure, {}}, u{"U_degC", Role::structure, {}}, z{"z_um", Role::measured, {}};
  for (int row = 0; row < 300; ++row) {
    log.time_s.push_back(60.0 * row);
    const bool gone = (row > 20 && row < 80) || (row > 150 && row < 250);
    t.values.push_back(gone ? kGap : 20.0 + row);
    u.values.push_back(row > 90 && row < 110 ? kGap : 20.0);
    z.values.push_back(row);
  }
  log.columns = {t, u, z};
  const std::vector<Series> parts{log};
  EXPECT_NE(message_of(parts, 600.0), "");
  const auto longest = longest_gap(parts, 600.0);
  ASSERT_TRUE(longest);
  EXPECT_EQ(longest->signal, "T_degC");
  EXPECT_EQ(longest->from_s, 9000.0);
  EXPECT_EQ(longest->to_s, 15000.0);
  EXPECT_EQ(merged(parts, longest->to_s - longest->from_s).time_s.size(), 300U);
  EXPECT_FALSE(longest_gap(parts, 6000.0));
}

TEST(Merged, says_what_is_wrong) {
  EXPECT_EQ(message_of({drift(), drift()}, 800.0), "expected every column once, found x_um twice.");
  EXPECT_EQ(message_of({drift(), signals()}, 600.0),
            "expected values of T_degC at most 10 min apart, found none between 6.67 and 20 min. A longer --max-gap "
            "interpolates over it.");
  EXPECT_EQ(message_of({drift(), signals()}, 20.0),
            "expected values of T_degC at most 20 s apart, found none between 0 and 400 s. A longer --max-gap "
            "interpolates over it.");
  Series empty = signals();
  empty.columns[0].values.assign(4, kGap);
  EXPECT_EQ(message_of({drift(), empty}, 800.0), "expected values of T_degC, found none.");
  Series late = drift();
  late.time_s = {6000.0, 7200.0, 9000.0};
  EXPECT_EQ(message_of({late, signals()}, 800.0),
            "expected times in common, found x_um from 100 to 150 min and signals from 0 to 20 min.");
  const Series never{{6000.0, 9000.0}, {{"U_degC", Role::structure, {1.0, 1.0}}}, std::nullopt};
  EXPECT_EQ(message_of({signals(), never}, 800.0),
            "expected times in common, found T_degC from 0 to 20 min, U_degC from 100 to 150 min.");
}

}  // namespace
}  // namespace ballbar
