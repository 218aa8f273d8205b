#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "ballbar/drift/thermal_test.hpp"
#include "drift/smooth_curve.hpp"

namespace ballbar {
namespace {

constexpr double kMinute_s = 60.0;

struct Record {
  std::vector<double> time_s, drift_um;
};

// A (1 - exp(-t / tau)) with white noise.
Record settling(double size_um, double tau_s, double step_s, double length_s, double noise_um, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, noise_um);
  Record record;
  for (double t = 0.0; t <= length_s; t += step_s) {
    record.time_s.push_back(t);
    record.drift_um.push_back(size_um * (1.0 - std::exp(-t / tau_s)) + noise(random));
  }
  return record;
}

TEST(stable_time, is_where_the_curve_enters_the_band) {
  const Record record = settling(30.0, 20.0 * kMinute_s, kMinute_s, 180.0 * kMinute_s, 0.01, 1);
  const std::optional<StableTime> stable = stable_time(record.time_s, record.drift_um, 3.0);
  ASSERT_TRUE(stable);
  EXPECT_NEAR(stable->time_s, 20.0 * kMinute_s * std::log(10.0), 10.0);
  EXPECT_NEAR(stable->final_um, 30.0, 0.03);
  EXPECT_TRUE(stable->reached);
  EXPECT_NEAR(stable->share_at_end, 1.0, 0.001);
}

TEST(stable_time, of_a_stretch_that_ends_too_early_lies_beyond_it) {
  const Record record = settling(30.0, 40.0 * kMinute_s, kMinute_s, 60.0 * kMinute_s, 0.05, 2);
  const std::optional<StableTime> stable = stable_time(record.time_s, record.drift_um, 3.0);
  ASSERT_TRUE(stable);
  EXPECT_FALSE(stable->reached);
  EXPECT_NEAR(stable->time_s, 40.0 * kMinute_s * std::log(10.0), 3.0 * stable->sigma_s);
  EXPECT_NEAR(stable->share_at_end, 1.0 - std::exp(-1.5), 0.02);
}

// Tests every 8 to 20 min, and logs; time constants of 10 to 60 min; stretches of 1.5 to 7 of them.
TEST(stable_time, two_sigma_hold_the_truth) {
  int held = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(seed + 4711);
    std::uniform_real_distribution<double> uniform;
    const double tau_s = kMinute_s * (10.0 + 50.0 * uniform(random)), size_um = 5.0 + 40.0 * uniform(random);
    const double step_s = seed % 2 == 0 ? kMinute_s : kMinute_s * (8.0 + 12.0 * uniform(random));
    const double length_s = tau_s * (1.5 + 5.5 * uniform(random)), noise_um = 0.05 + 0.3 * uniform(random);
    const Record record = settling(size_um, tau_s, step_s, length_s, noise_um, seed);
    const double band_um = std::max(2.0, 0.1 * size_um);
    const std::optional<StableTime> stable = stable_time(record.time_s, record.drift_um, band_um);
    if (!stable) continue;
    ++all;
    if (std::abs(stable->time_s - tau_s * std::log(size_um / band_um)) <= 2.0 * stable->sigma_s) ++held;
  }
  EXPECT_GE(all, 150);
  EXPECT_GE(held, 0.92 * all) << held << " of " << all;
  EXPECT_LT(held, all) << "no sigma is that wide";
}

TEST(stable_time, noise_alone_and_few_rows_have_none) {
  const Record noise = settling(0.0, 600.0, kMinute_s, 180.0 * kMinute_s, 0.3, 3);
  const std::optional<StableTime> stable = stable_time(noise.time_s, noise.drift_um, 2.0);
  EXPECT_TRUE(!stable || stable->time_s == 0.0);
  EXPECT_FALSE(stable_time(std::vector{0.0, 60.0, 120.0}, std::vector{0.0, 1.0, 1.5}, 0.1));
}

TEST(settling_of, leaves_out_where_the_spindle_cools) {
  Record record = settling(30.0, 20.0 * kMinute_s, 4.0 * kMinute_s, 120.0 * kMinute_s, 0.02, 4);
  for (int k = 1; k <= 20; ++k) {
    record.time_s.push_back(record.time_s.back() + 4.0 * kMinute_s);
    record.drift_um.push_back(30.0 * std::exp(-k / 5.0));
  }
  MeasuredDrift drift;
  drift.time_s = record.time_s;
  drift.axes = {{"y", "um", record.drift_um, {}},
                {"x", "um", std::vector<double>(record.time_s.size(), 0.5), {}},
                {"tilt_a", "urad", record.drift_um, {}}};
  const std::vector<AxisSettling> all = settling_of(drift, 0, drift.time_s.size());
  ASSERT_EQ(all.size(), 2);
  ASSERT_TRUE(all[0].stable);
  EXPECT_NEAR(all[0].band_um, 3.0, 0.1);
  EXPECT_NEAR(all[0].stable->time_s, 20.0 * kMinute_s * std::log(30.0 / all[0].band_um), 60.0);
  EXPECT_TRUE(all[1].is_small);
  EXPECT_FALSE(all[1].stable);
  EXPECT_DOUBLE_EQ(settling_of(drift, 0, drift.time_s.size(), 1.0)[0].band_um, 1.0);
}

TEST(combined_drift, is_the_root_of_the_sum_of_squares) {
  DriftPoint point;
  point.x = Estimate{3.0, 0.1};
  EXPECT_FALSE(combined_drift(point));
  point.z = Estimate{-4.0, 0.2};
  EXPECT_DOUBLE_EQ(combined_drift(point)->value_um, 5.0);
  EXPECT_NEAR(combined_drift(point)->sigma_um, std::hypot(0.6 * 0.1, 0.8 * 0.2), 1e-12);
}

// Largest less smallest reading is too large by 0.7 um at this noise.
TEST(smooth_ranges, are_freed_of_noise) {
  double bias_um = 0.0, readings_um = 0.0, sigma_um = 0.0;
  constexpr int kSeeds = 40;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Record record = settling(30.0, 25.0 * kMinute_s, kMinute_s, 240.0 * kMinute_s, 0.3, seed);
    const std::pair<std::size_t, std::size_t> all[] = {{0, record.time_s.size()}};
    const Estimate range = smooth_ranges(record.time_s, record.drift_um, all).front();
    const auto [least, most] = std::minmax_element(record.drift_um.begin(), record.drift_um.end());
    const double truth_um = 30.0 * (1.0 - std::exp(-240.0 / 25.0));
    bias_um += (range.value_um - truth_um) / kSeeds;
    readings_um += (*most - *least - truth_um) / kSeeds;
    sigma_um += range.sigma_um / kSeeds;
  }
  EXPECT_GT(readings_um, 0.5);
  EXPECT_LT(std::abs(bias_um), 0.3 * sigma_um);
  EXPECT_LT(sigma_um, 0.4);
}

}  // namespace
}  // namespace ballbar
