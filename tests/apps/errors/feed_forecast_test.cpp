#include "errors/feed_forecast.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace ballbar {
namespace {

constexpr double kFeed_mm_per_min = 2000.0;  // 33.3 um/ms
constexpr double kServo_um = 10.0 / 3.0;     // (V / 2) 0.2 ms

// Both directions with the oval of a scale mismatch of 4 um, cos 2 theta, and of a servo mismatch, dir 3.33 sin 2
// theta. Together they have the amplitude sqrt(1 + 3.33^2), and C is twice that: 6.96 um. Noise of 0.01 um.
std::vector<Recording> circles(double servo_um = kServo_um) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise_um(0.0, 0.01);
  std::vector<Recording> recordings(2);
  for (Recording& one : recordings) {
    one.direction = &one == recordings.data() ? Direction::CCW : Direction::CW;
    one.feed_mm_per_min = kFeed_mm_per_min;
    const bool ccw = one.direction == Direction::CCW;
    constexpr int kReadings = 720;
    for (int i = 0; i < kReadings; ++i) {
      const double part = 2.0 * std::numbers::pi * (i + 0.5) / kReadings;
      const double theta = ccw ? part : 2.0 * std::numbers::pi - part;
      const double um = std::cos(2.0 * theta) + (ccw ? servo_um : -servo_um) * std::sin(2.0 * theta) + noise_um(random);
      one.angle_rad.push_back(theta);
      one.length_mm.push_back(100.0 + 1e-3 * (um + 20.0 * std::cos(theta)));  // off centre by 20 um
    }
  }
  return recordings;
}

// C(f) = 2 sqrt(1 + (3.33 u)^2) = T at u = f / V = sqrt(T^2 / 4 - 1) / 3.33.
TEST(feed_forecast, feed_that_holds_the_tolerance) {
  const std::vector<Recording> recordings = circles();
  const MachineErrors found = machine_errors(recordings);
  EXPECT_NEAR(found.circularity_um, 2.0 * std::hypot(1.0, kServo_um), 0.06) << "noise of 0.01 um adds to the extremes";
  const auto forecast = feed_forecast(found, recordings, 5.0);
  ASSERT_TRUE(forecast && forecast->feed_mm_per_min);
  const double u = std::sqrt(5.25) / kServo_um;
  EXPECT_NEAR(*forecast->feed_mm_per_min, u * kFeed_mm_per_min, 25.0) << "0.06 um at 2.5 um per 1000 mm/min";
  EXPECT_NEAR(forecast->circularity_without_um, 2.0, 0.06);
  // dC/df = 4 u 3.33^2 / (C V), dC/dk = - (1 - u) V dC/df
  const double per_feed = 4.0 * u * kServo_um * kServo_um / (5.0 * kFeed_mm_per_min);
  double mismatch_share = 0.0;
  for (const MachineError& error : found.errors) {
    if (error.name == "servo_mismatch") mismatch_share = error.sigma / error.value;
  }
  const double sigma_um = std::sqrt(2.0) * std::hypot(found.noise.white_um, found.noise.correlated_um);
  const double expected = std::hypot((1.0 - u) * kFeed_mm_per_min * mismatch_share, sigma_um / per_feed);
  EXPECT_NEAR(forecast->sigma_mm_per_min, expected, 0.05 * expected);
}

TEST(feed_forecast, none_without_need_or_cause) {
  std::vector<Recording> recordings = circles();
  MachineErrors found = machine_errors(recordings);
  EXPECT_FALSE(feed_forecast(found, recordings, 8.0)) << "holds";
  const auto none = feed_forecast(found, recordings, 1.5);
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->feed_mm_per_min) << "the scale mismatch alone is beyond it";
  EXPECT_EQ(forecast_text(*none).substr(0, 49), "No feed would hold 1.5 um: without servo mismatch");
  recordings[1].feed_mm_per_min.reset();
  EXPECT_FALSE(feed_forecast(found, recordings, 5.0)) << "a feed is not stated";
  recordings = circles(0.0);
  found = machine_errors(recordings);
  EXPECT_FALSE(feed_forecast(found, recordings, 1.5)) << "no servo mismatch";
}

TEST(feed_forecast, sentence) {
  EXPECT_EQ(
      forecast_text({6.0, 2.0, 600.4, 60.3}),
      "At 600 ± 60 mm/min the circularity would be 6 um, if servo mismatch is its only part that grows with the feed "
      "(forecast of the fitted model).");
}

}  // namespace
}  // namespace ballbar
