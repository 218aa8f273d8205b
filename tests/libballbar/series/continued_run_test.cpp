#include "ballbar/internal/series/continued_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballbar {
namespace {

// A temperature that rises and falls, one row a minute, between two times.
Series run_of(double from_min, double to_min, double offset_K = 0.0) {
  Series run;
  Column column{"T_degC", Role::structure, {}};
  for (double time_min = from_min; time_min <= to_min; time_min += 1.0) {
    run.time_s.push_back(60.0 * time_min);
    column.values.push_back(20.0 + 5.0 * std::sin(time_min / 30.0) + offset_K);
  }
  run.columns.push_back(column);
  return run;
}

const std::vector<std::string> kInputs{"T_degC"};

TEST(continued_run, is_a_part_of_the_run) {
  const Series run = run_of(0, 200);
  const auto part = continued_run(run, run_of(50, 80), kInputs);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->series.time_s, run.time_s);
  EXPECT_EQ(part->time_s.front(), 3000.0);
  EXPECT_EQ(part->pause_s, 0.0);
}

TEST(continued_run, follows_or_overlaps) {
  const Series run = run_of(0, 200), whole = run_of(0, 300);
  for (const double from_min : {201.0, 150.0}) {
    const auto later = continued_run(run, run_of(from_min, 300), kInputs);
    ASSERT_TRUE(later) << from_min;
    EXPECT_EQ(later->series.time_s, whole.time_s);
    EXPECT_EQ(later->series.columns[0].values, whole.columns[0].values);
  }
  EXPECT_DOUBLE_EQ(continued_run(run, run_of(230, 300), kInputs)->pause_s, 1800.0);
  EXPECT_FALSE(continued_run(run, run_of(200 + 500, 800), kInputs));  // 8 h and more
}

TEST(continued_run, begins_before_the_run) {
  const auto found = continued_run(run_of(100, 200), run_of(0, 150), kInputs);
  ASSERT_TRUE(found);
  EXPECT_TRUE(std::isnan(found->time_s[99]));
  EXPECT_EQ(found->time_s[100], 6000.0);
  EXPECT_EQ(found->series.time_s, run_of(100, 200).time_s);
  EXPECT_FALSE(continued_run(run_of(100, 200), run_of(0, 50), kInputs));
}

TEST(continued_run, lies_between_the_rows) {
  Series odd = run_of(0, 200), even = odd;
  for (std::size_t row = 0; row < odd.time_s.size(); ++row) odd.time_s[row] += 30.0;
  for (std::size_t row = 0; row + 1 < odd.time_s.size(); ++row)
    odd.columns[0].values[row] = 0.5 * (even.columns[0].values[row] + even.columns[0].values[row + 1]);
  const auto found = continued_run(even, odd, kInputs);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->series.time_s.size(), 402u);
  for (double& value : odd.columns[0].values) value += 1.0;  // 6 steps
  EXPECT_FALSE(continued_run(even, odd, kInputs));
}

TEST(continued_run, is_another_run) {
  const Series run = run_of(0, 200);
  EXPECT_FALSE(continued_run(run, run_of(0, 200, 0.001), kInputs));  // the same times, other values
  EXPECT_TRUE(continued_run(run, run_of(0, 200, 0.001), {}));        // that nothing reads
  EXPECT_FALSE(continued_run(run, run_of(50, 80), {"T_degC", "T_room_degC"}));
  Series numbered = run_of(50, 80);
  numbered.has_clock = false;
  EXPECT_FALSE(continued_run(run, numbered, kInputs));
}

TEST(continued_run, by_another_clock) {
  Series later = run_of(50, 80);
  for (double& time_s : later.time_s) time_s -= 3000.0;
  EXPECT_FALSE(continued_run(run_of(0, 200), later, kInputs));
  EXPECT_TRUE(continued_run(run_of(0, 200), later, kInputs, 3000.0));
}

}  // namespace
}  // namespace ballbar
