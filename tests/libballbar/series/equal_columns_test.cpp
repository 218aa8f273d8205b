#include "series/equal_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "series/stuck_rows.hpp"

namespace ballbar {
namespace {

struct Sensors {
  std::mt19937_64 random{5};
  double normal() { return std::normal_distribution<double>()(random); }

  // A warming-up and a cycle with the noise of a sensor, logged to 0.1 K, of a body that follows by `lag` rows.
  std::vector<double> read(double lag, double sigma, std::size_t n = 500, double offset = 20.0) {
    std::vector<double> values;
    double body = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double row = static_cast<double>(i);
      const double source = 10.0 * (1.0 - std::exp(-row / 90.0)) + 2.0 * std::sin(0.03 * row);
      body = lag > 0.0 ? body + (source - body) / lag : source;
      values.push_back(std::round(10.0 * (offset + body + sigma * normal())) / 10.0);
    }
    return values;
  }
};

TEST(equal_columns, are_two_sensors_in_one_place) {
  Sensors sensors;
  const std::vector<double> first = sensors.read(0.0, 0.08);
  std::vector<double> second = sensors.read(0.0, 0.08);
  for (double& value : second) value = 1.03 * value + 3.0;
  const auto relation = equal_columns(first, second);
  ASSERT_TRUE(relation);
  EXPECT_NEAR(relation->slope, 1.03, 0.005);
  EXPECT_NEAR(relation->offset, 3.0, 0.2);
}

TEST(equal_columns, may_differ_in_noise) {
  Sensors sensors;
  const auto relation = equal_columns(sensors.read(0.0, 0.02), sensors.read(0.0, 0.3));
  ASSERT_TRUE(relation);
  EXPECT_NEAR(relation->slope, 1.0, 0.05);
}

// Rounded, they differ by up to a step.
TEST(equal_columns, may_be_rounded_without_noise) {
  Sensors sensors;
  EXPECT_TRUE(equal_columns(sensors.read(0.0, 0.0), sensors.read(0.0, 0.0, 500, 20.35)));
}

TEST(equal_columns, are_not_two_bodies_of_which_one_is_slower) {
  Sensors sensors;
  EXPECT_FALSE(equal_columns(sensors.read(0.0, 0.08), sensors.read(3.0, 0.08)));
  EXPECT_FALSE(equal_columns(sensors.read(0.0, 0.08, 100), sensors.read(4.0, 0.08, 100)));
  EXPECT_FALSE(equal_columns(sensors.read(0.0, 0.0), sensors.read(4.0, 0.0)));
}

TEST(equal_columns, are_not_two_bodies_of_which_one_gets_half_or_none) {
  Sensors sensors;
  const std::vector<double> first = sensors.read(0.0, 0.08);
  std::vector<double> half = sensors.read(0.0, 0.08), falling = half;
  for (double& value : half) value *= 0.5;
  for (double& value : falling) value *= -1.0;
  EXPECT_FALSE(equal_columns(first, half));
  EXPECT_FALSE(equal_columns(first, falling));
  EXPECT_FALSE(equal_columns(first, std::vector<double>(first.size(), 20.0)));
}

TEST(equal_columns, need_values_in_the_same_rows_and_enough) {
  Sensors sensors;
  std::vector<double> first = sensors.read(0.0, 0.08), second = first;
  EXPECT_TRUE(equal_columns(first, second));
  second[7] = std::nan("");
  EXPECT_FALSE(equal_columns(first, second));
  first[7] = std::nan("");
  EXPECT_TRUE(equal_columns(first, second));
  EXPECT_FALSE(equal_columns(sensors.read(0.0, 0.08, 40), sensors.read(0.0, 0.08, 40)));
}

TEST(equal_columns, are_compared_at_what_a_logger_reads) {
  Sensors sensors;
  const auto held = [](std::vector<double> values) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = values[i / 5 * 5];
    return values;
  };
  const std::vector<double> first = held(sensors.read(0.0, 0.08)), second = held(sensors.read(0.0, 0.08));
  EXPECT_TRUE(equal_columns(first, second, 5));
  EXPECT_FALSE(equal_columns(first, second));
}

TEST(stuck_runs, are_those_without_the_noise_of_the_other_rows) {
  Sensors sensors;
  std::vector<double> values = sensors.read(0.0, 0.08);
  EXPECT_TRUE(stuck_runs(values).empty());
  std::fill(values.begin() + 150, values.begin() + 180, values[150]);
  const std::vector<RowRange> runs = stuck_runs(values);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_GE(runs[0].begin, 148U);
  EXPECT_LE(runs[0].begin, 150U);
  EXPECT_EQ(runs[0].end, 180U);
}

TEST(stuck_runs, may_end_the_column) {
  Sensors sensors;
  std::vector<double> values = sensors.read(0.0, 0.08);
  std::fill(values.begin() + 420, values.end(), values[420]);
  ASSERT_EQ(stuck_runs(values).size(), 1U);
  EXPECT_EQ(stuck_runs(values)[0].end, values.size());
}

// A temperature rests, and goes on from where it is.
TEST(stuck_runs, are_none_of_a_temperature_at_rest) {
  Sensors sensors;
  std::vector<double> values = sensors.read(0.0, 0.08, 200);
  const double last = values.back();
  values.insert(values.end(), 100, last);
  for (int i = 0; i < 200; ++i) values.push_back(std::round(10.0 * (last + 0.05 + 0.08 * sensors.normal())) / 10.0);
  values[300] = last + 0.1;
  EXPECT_TRUE(stuck_runs(values).empty());
}

// A temperature without noise comes to rest at the end.
TEST(stuck_runs, are_none_of_a_smooth_column) {
  Sensors sensors;
  std::vector<double> values = sensors.read(0.0, 0.0, 200);
  values.insert(values.begin(), 100, values.front());
  values.insert(values.end(), 200, values.back());
  EXPECT_TRUE(stuck_runs(values).empty());
}

// Its noise does not show elsewhere either: it rests by turns, and jumps where a machine starts.
TEST(stuck_runs, are_none_of_a_column_that_often_rests) {
  std::vector<double> values;
  for (int block = 0; block < 10; ++block) {
    for (int i = 0; i < 60; ++i) values.push_back(20.0 + (block % 2 == 0 ? 0.0 : 0.1 * (i % 2)));
    values.push_back(21.0);
  }
  EXPECT_TRUE(stuck_runs(values).empty());
}

}  // namespace
}  // namespace ballbar
