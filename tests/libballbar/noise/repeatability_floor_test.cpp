// The floor: repeats, standstill, innovations, stated sigma.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ballbar/noise/noise.hpp"

namespace ballbar {
namespace {

struct Record {
  std::vector<double> time_s, target_um, speed_rpm;

  // Rows a minute apart; noise of 0.3 um on an exponential towards `end_um`.
  void run(double rpm, std::size_t rows, double end_um, double tau_min) {
    const double begin_um = last_um;
    for (std::size_t i = 0; i < rows; ++i) {
      time_s.push_back(60.0 * static_cast<double>(time_s.size()));
      last_um = end_um + (begin_um - end_um) * std::exp(-static_cast<double>(i) / tau_min);
      target_um.push_back(last_um + 0.3 * normal(random));
      speed_rpm.push_back(rpm);
    }
  }

  double last_um = 0.0;
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
};

constexpr Noise kLarge{5.0, 0.0, 0.0, 0.0};  // passes nothing over

// 8000 rpm for 200 min after rest, twice: white 0.3 um +- 0.3 / sqrt(2 * 200) = 0.015, within 4 of these. The first
// rest has nothing before it, the second is alone.
TEST(Floor, of_repeats) {
  Record record;
  record.run(0.0, 100, 0.0, 20.0);
  record.run(8000.0, 200, 20.0, 20.0);
  record.run(0.0, 300, 0.0, 20.0);
  record.run(8000.0, 205, 20.0, 20.0);
  const Floor floor = floor_of(record.time_s, record.target_um, {}, record.speed_rpm, kLarge);
  EXPECT_EQ(text_of(floor.source), "a pair of repeats");
  EXPECT_NEAR(floor.rms_um, 0.3, 0.06);
}

// As above; the room moves the second repeat by 5 um, evenly.
TEST(Floor, of_repeats_beside_a_slow_drift) {
  Record record;
  record.run(0.0, 100, 0.0, 20.0);
  record.run(8000.0, 200, 20.0, 20.0);
  record.run(0.0, 300, 0.0, 20.0);
  const std::size_t second = record.target_um.size();
  record.run(8000.0, 205, 20.0, 20.0);
  for (std::size_t i = second; i < record.target_um.size(); ++i)
    record.target_um[i] += 5.0 * static_cast<double>(i - second) / 200.0;
  const Floor floor = floor_of(record.time_s, record.target_um, {}, record.speed_rpm, kLarge);
  EXPECT_EQ(text_of(floor.source), "a pair of repeats");
  EXPECT_NEAR(floor.rms_um, 0.3, 0.06);
}

// Two repeats 5 um apart by the second's drift differ by more than a residual of 0.4 um has: something else went on.
// The rest of 300 min holds 180 min of standstill, rows 420 to 599 (rest begins at 300 min): 0.3 um +- 0.016. What is
// left of the exponential after 2 h, 20 exp(-6) = 0.05 um, is small beside it.
TEST(Floor, of_a_standstill_where_repeats_differ) {
  Record record;
  record.run(0.0, 100, 0.0, 20.0);
  record.run(8000.0, 200, 20.0, 20.0);
  record.run(0.0, 300, 0.0, 20.0);
  record.run(8000.0, 200, 40.0, 20.0);
  const Floor floor = floor_of(record.time_s, record.target_um, {}, record.speed_rpm, {0.4, 0.0, 0.0, 0.0});
  EXPECT_EQ(text_of(floor.source), "standstill from 420 to 599 min");
  EXPECT_NEAR(floor.rms_um, 0.3, 0.064);
}

// Steady filter of q = 1, a = 1/2, w = 1 by hand: p = (1 - 1/4) + p / (4 (p + 1)), so p^2 = 3/4 and S = 1 + sqrt(3) /
// 2; the first rows have more: their part of 2000 rows is below 1e-4.
TEST(Floor, of_the_innovations) {
  const std::vector<double> time_s = [] {
    std::vector<double> times;
    for (int i = 0; i < 2000; ++i) times.push_back(60.0 * i);
    return times;
  }();
  const std::vector<double> target(2000, 0.0);
  const Noise noise{1.0, 1.0, 60.0 / std::log(2.0), 0.0};
  const Floor floor = floor_of(time_s, target, {}, {}, noise);
  EXPECT_EQ(text_of(floor.source), "error of predicting the next reading");
  EXPECT_NEAR(floor.rms_um, std::sqrt(1.0 + std::sqrt(0.75)), 1e-3);
  EXPECT_EQ(text_of(floor_of(time_s, target, {}, std::vector<double>(2000, 3000.0), noise).source),
            text_of(floor.source));
}

// sqrt((3^2 + 1^2) / 2) = 2.236; more than the scatter of the residual, or nothing else known.
TEST(Floor, is_never_below_the_stated_sigma) {
  std::vector<double> time_s, sigma;
  for (int i = 0; i < 40; ++i) {
    time_s.push_back(600.0 * i);
    sigma.push_back(i % 2 == 0 ? 3.0 : 1.0);
  }
  const std::vector<double> target(40, 0.0);
  const Floor floor = floor_of(time_s, target, sigma, {}, {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(text_of(floor.source), "sigma of the circle fits");
  EXPECT_NEAR(floor.rms_um, std::sqrt(5.0), 1e-12);
  const Floor above = floor_of(time_s, target, sigma, {}, {2.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(text_of(above.source), "error of predicting the next reading");
  EXPECT_NEAR(above.rms_um, 3.0, 1e-12);
}

// A white residual of few readings would be its own floor: every model would look good enough.
TEST(Floor, of_few_readings_is_the_stated_sigma_alone) {
  std::vector<double> time_s;
  for (int i = 0; i < 14; ++i) time_s.push_back(600.0 * i);
  const std::vector<double> target(14, 0.0), sigma(14, 0.02);
  const Floor floor = floor_of(time_s, target, sigma, {}, {9.8, 0.0, 0.0, 0.0});
  EXPECT_EQ(text_of(floor.source), "sigma of the circle fits");
  EXPECT_NEAR(floor.rms_um, 0.02, 1e-12);
}

TEST(Floor, of_few_readings_is_not_known) {
  const std::vector<double> time_s{0.0, 60.0, 120.0}, target{1.0, 2.0, 3.0};
  const Floor floor = floor_of(time_s, target, {}, {}, {1.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(floor.rms_um, 0.0);
  EXPECT_EQ(text_of(floor.source), "");
  EXPECT_TRUE(floor_of({}, {}, {}, {}, {}).source.empty());
}

}  // namespace
}  // namespace ballbar
