#include "ballbar/internal/series/signal_kind.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

template <class Value>
std::vector<double> rows(std::size_t count, Value value) {
  std::vector<double> values;
  for (std::size_t row = 0; row < count; ++row) values.push_back(value(static_cast<double>(row)));
  return values;
}

TEST(signal_kind, one_value_or_none_is_still) {
  EXPECT_EQ(signal_kind({}), SignalKind::still);
  EXPECT_EQ(signal_kind(std::vector<double>{kGap, kGap}), SignalKind::still);
  EXPECT_EQ(signal_kind(std::vector<double>{kGap, 21.5, 21.5, kGap, 21.5}), SignalKind::still);
}

TEST(signal_kind, row_numbers_and_seconds_are_counters) {
  EXPECT_EQ(signal_kind(rows(8, [](double row) { return row + 1.0; })), SignalKind::counter);
  EXPECT_EQ(signal_kind(rows(500, [](double row) { return 1.78e9 + 0.1 * row; })), SignalKind::counter);
  // A logger that is a second late in every seventh row.
  EXPECT_EQ(signal_kind(rows(100, [](double row) { return 60.0 * row + std::floor(row / 7.0); })), SignalKind::counter);
  // Cycles of 30 rows, whose record ends within one.
  EXPECT_EQ(signal_kind(rows(315, [](double row) { return std::floor(row / 30.0); })), SignalKind::counter);
}

// All of these never fall and have two sizes of change.
TEST(signal_kind, what_rises_alone_need_not_count) {
  EXPECT_EQ(signal_kind(rows(100, [](double row) { return row < 40.0 ? 0.0 : 1.0; })), SignalKind::steps);
  EXPECT_EQ(signal_kind(rows(400, [](double row) { return 1000.0 * std::floor(row / 100.0); })), SignalKind::steps);
  // To whole degrees, from 20 to 45 degC with a time constant of 200 rows.
  EXPECT_EQ(signal_kind(rows(1500, [](double row) { return std::round(45.0 - 25.0 * std::exp(-row / 200.0)); })),
            SignalKind::steps);
}

// 3 of 20 changes are 15 %, no fewer; 3 of 21 are.
TEST(signal_kind, steps_are_fewer_than_15_percent_of_the_changes) {
  std::vector<double> values(21, 0.0);
  std::fill_n(values.begin() + 3, 4, 1.0);
  std::fill_n(values.begin() + 10, 11, 2.0);
  EXPECT_EQ(signal_kind(values), SignalKind::smooth);
  values.push_back(2.0);
  EXPECT_EQ(signal_kind(values), SignalKind::steps);
}

TEST(signal_kind, two_values_are_steps_however_often_they_change) {
  EXPECT_EQ(signal_kind(std::vector<double>{0.0, 1.0, 0.0}), SignalKind::steps);
  EXPECT_EQ(signal_kind(rows(100, [](double row) { return 18.0 + 6.0 * std::fmod(row, 2.0); })), SignalKind::steps);
}

// A pulse of one row, up and down, by 1: movement 2. Beside it 96 changes of 0.02, together 1.92, or of 0.025, 2.4.
TEST(signal_kind, steps_make_more_than_half_of_the_movement) {
  for (const double noise : {0.02, 0.025}) {
    std::vector<double> values = rows(99, [&](double row) { return std::fmod(row, 2.0) * noise; });
    values[50] = 1.0;
    EXPECT_EQ(signal_kind(values), noise < 0.022 ? SignalKind::steps : SignalKind::smooth) << noise;
  }
}

TEST(signal_kind, a_temperature_is_smooth) {
  const auto warm = [](double row) { return std::round(10.0 * (20.0 + 3.0 * std::sin(row / 60.0))) / 10.0; };
  EXPECT_EQ(signal_kind(rows(600, warm)), SignalKind::smooth);
  EXPECT_EQ(signal_kind(std::vector<double>{20.0, 24.3, 27.3, 29.5, 31.0, 32.2}), SignalKind::smooth);
}

TEST(signal_kind, gaps_are_ignored) {
  const auto pump = [](double row) {
    return std::fmod(row, 3.0) == 1.0 ? kGap : std::fmod(row, 100.0) < 50.0 ? 0.0 : 1.0;
  };
  EXPECT_EQ(signal_kind(rows(400, pump)), SignalKind::steps);
}

}  // namespace
}  // namespace ballbar
