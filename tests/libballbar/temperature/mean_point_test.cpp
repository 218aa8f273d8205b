#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/temperature/temperature.hpp"

namespace ballbar {
namespace {

// T = 40 - x / 10 over 100 mm: mean 35 at x = 50, slope -0.1. alpha L = 10 ppm/K times 100 mm = 1 um/K, so 0.1 um/mm.
TEST(mean_point, of_a_straight_line_is_its_middle) {
  const TemperatureProfile line{{0, 100}, {40, 30}, {}};
  EXPECT_DOUBLE_EQ(mean_degC(line), 35.0);
  const auto points = mean_points(line);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_DOUBLE_EQ(points[0].x_mm, 50.0);
  EXPECT_DOUBLE_EQ(points[0].slope_degC_per_mm, -0.1);
  EXPECT_DOUBLE_EQ(misplacement_um_per_mm(line, points[0], 10.0), 0.1);
}

// T = 20 + 30 exp(-x / 100) over 300 mm. (1/L) integral = 20 + 10 (1 - e^-3) = 29.50213, which T has at
// x = -100 ln((1 - e^-3) / 3) = 114.9923 mm, with the slope -0.09502. Straight lines of 0.5 mm: their mean is above by
// h^2 (T'(L) - T'(0)) / (12 L) = 0.25 (0.285) / 3600 = 2e-5 degC, so x is off by 2e-4 mm.
TEST(mean_point, of_an_exponential) {
  TemperatureProfile profile;
  for (int i = 0; i <= 600; ++i) {
    profile.x_mm.push_back(0.5 * i);
    profile.degC.push_back(20.0 + 30.0 * std::exp(-0.005 * i));
  }
  const double e3 = std::exp(-3.0);
  EXPECT_NEAR(mean_degC(profile), 20.0 + 10.0 * (1.0 - e3), 3e-5);
  const auto points = mean_points(profile);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x_mm, -100.0 * std::log((1.0 - e3) / 3.0), 1e-3);
  EXPECT_NEAR(points[0].slope_degC_per_mm, -0.1 * (1.0 - e3), 3e-4);
}

// A roof, 20 at both ends and 40 in the middle of 80 mm: mean 30, at 20 and 60 mm, slopes +-0.5.
TEST(mean_point, of_a_roof_are_two) {
  const auto points = mean_points({{0, 40, 80}, {20, 40, 20}, {}});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_DOUBLE_EQ(points[0].x_mm, 20.0);
  EXPECT_DOUBLE_EQ(points[0].slope_degC_per_mm, 0.5);
  EXPECT_DOUBLE_EQ(points[1].x_mm, 60.0);
  EXPECT_DOUBLE_EQ(points[1].slope_degC_per_mm, -0.5);
}

// Steps are uneven: 10 mm at 30 rising to 40, then 90 mm at 40 falling to 30: mean 35 whatever the steps; the mean of
// the three samples would be 33.3.
TEST(mean_point, weights_by_length) {
  const TemperatureProfile profile{{0, 10, 100}, {30, 40, 30}, {}};
  EXPECT_DOUBLE_EQ(mean_degC(profile), 35.0);
}

// Weights 5, 50 and 45 of 100 mm: sigma = 0.05 * 0.2 + 0.5 * 0.1 + 0.45 * 0.4 = 0.24.
TEST(mean_point, sigma_of_the_mean) {
  EXPECT_NEAR(sigma_of_mean_degC({{0, 10, 100}, {30, 40, 30}, {0.2, 0.1, 0.4}}), 0.24, 1e-12);
  EXPECT_TRUE(std::isnan(sigma_of_mean_degC({{0, 10, 100}, {30, 40, 30}, {}})));
}

// 30, 30 over the first half, then down to 20 and up to 40: mean 30 on the stretch 0 to 50 and where the V crosses.
TEST(mean_point, of_a_level_stretch_is_its_middle) {
  const auto points = mean_points({{0, 50, 60, 80, 90}, {30, 30, 20, 40, 30}, {}});
  ASSERT_EQ(points.size(), 3u);
  EXPECT_DOUBLE_EQ(points[0].from_mm, 0.0);
  EXPECT_DOUBLE_EQ(points[0].to_mm, 50.0);
  EXPECT_DOUBLE_EQ(points[0].x_mm, 25.0);
  EXPECT_DOUBLE_EQ(points[0].slope_degC_per_mm, 0.0);
  EXPECT_DOUBLE_EQ(points[1].x_mm, 70.0);
  EXPECT_DOUBLE_EQ(points[2].x_mm, 90.0);
}

TEST(mean_point, of_one_temperature_is_everywhere) {
  const auto points = mean_points({{0, 0.1, 0.3}, {30.1, 30.1, 30.1}, {}});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_DOUBLE_EQ(points[0].from_mm, 0.0);
  EXPECT_DOUBLE_EQ(points[0].to_mm, 0.3);
}

// 40 to 30 with a ripple of 0.02 at 48 to 52 mm around the level 35: three crossings, 0.02 apart from the level at
// most.
TEST(mean_point, crossings_within_the_scatter_are_one) {
  const TemperatureProfile profile{{0, 48, 50, 52, 100}, {40, 34.98, 35.02, 34.98, 30}, {}};
  EXPECT_EQ(points_at(profile, 35.0).size(), 3u);
  EXPECT_EQ(points_at(profile, 35.0, 0.01).size(), 3u);
  const auto points = points_at(profile, 35.0, 0.03);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x_mm, 49.4, 0.01);  // the middle of 47.81, where the first line is 35, and 51
  EXPECT_NEAR(points[0].slope_degC_per_mm, -0.0607, 1e-4);
}

// T = 40 - x / 10 over 100 mm in steps of 1 mm, but 0.04 too low at 50 and 0.04 too high at 51 mm: between those two
// it falls by 0.02 only, over 48 to 52.x mm as it should. The point is where 34.96 - 0.02 (x - 50) and its neighbours
// are the mean 35: on 49 to 50 mm, from 35.1 by -0.14, at 49 + 0.1 / 0.14 = 49.714. p, q = 2 mm to each side, T(p) =
// 40 - 4.7714, T(q) on 51 to 52, from 34.94 by -0.14: 34.94 - 0.14 * 0.7143 = 34.84. Slope (34.84 - 35.22857) / 4 =
// -0.09714. Sigma 0.1 everywhere: hypot(0.1, 0.1) / 4 = 0.035355.
TEST(mean_point, slope_is_not_that_of_two_neighbours) {
  TemperatureProfile profile;
  for (int i = 0; i <= 100; ++i) {
    profile.x_mm.push_back(i);
    profile.degC.push_back(40.0 - 0.1 * i);
    profile.sigma_degC.push_back(0.1);
  }
  profile.degC[50] -= 0.04;
  profile.degC[51] += 0.04;
  const auto points = mean_points(profile);
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(points[0].x_mm, 49.0 + 0.1 / 0.14, 1e-9);
  EXPECT_NEAR(points[0].slope_degC_per_mm, -0.0971429, 1e-6);
  EXPECT_NEAR(sigma_of_slope_degC_per_mm(profile, points[0]), 0.0353553, 1e-6);
}

// Samples 50 mm apart: their own line, (45 - 25) / 100 mm, sigma hypot(0.3, 0.4) / 100 = 0.005.
TEST(mean_point, slope_of_far_samples_is_that_of_their_line) {
  const TemperatureProfile profile{{0, 100}, {25, 45}, {0.3, 0.4}};
  const auto points = mean_points(profile);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_DOUBLE_EQ(points[0].slope_degC_per_mm, 0.2);
  EXPECT_DOUBLE_EQ(sigma_of_slope_degC_per_mm(profile, points[0]), 0.005);
  EXPECT_TRUE(std::isnan(sigma_of_slope_degC_per_mm({{0, 100}, {25, 45}, {}}, points[0])));
}

// The paper's spindle: 13.6 ppm/K * 165 mm * 9 K = 20.196 um.
TEST(mean_point, elongation_by_hand) { EXPECT_NEAR(mean_point_elongation_um(13.6, 165.0, 9.0), 20.196, 1e-12); }

TEST(mean_point, the_integral_mean_value_theorem_holds) {
  const TemperatureProfile profile{{0, 3, 7, 20, 31}, {25, 48, 31, 39, 22}, {}};
  const auto points = mean_points(profile);
  ASSERT_FALSE(points.empty());
  for (const MeanPoint& point : points) {
    EXPECT_NEAR(temperature_at(profile, point.x_mm), mean_degC(profile), 1e-12);
    EXPECT_NEAR(mean_point_elongation_um(11.7, length_mm(profile), temperature_at(profile, point.x_mm) - 22.0),
                1e-3 * 11.7 * length_mm(profile) * (mean_degC(profile) - 22.0), 1e-12);
  }
}

// Lines 40 - x/10 (mean point 50) and 50 - x/5 over 0 to 100 with a kink to be off: the second falls 40 to 20 over the
// first 50 mm and stays; mean 25, at 37.5. alpha L = 1 um/K. Errors e1 = (50 - x)/10, e2 = 0.4 (37.5 - x) up to 50 mm:
// least sum of squares at x = (0.01 * 50 + 0.16 * 37.5) / 0.17 = 38.2353, e1 = 1.17647, e2 = -0.294118. The steeper
// slope there is -0.4 degC/mm: 0.4 um/mm.
TEST(best_point, weighs_the_steeper_state_more) {
  const std::vector<TemperatureProfile> states{{{0, 100}, {40, 30}, {}}, {{0, 50, 100}, {40, 20, 20}, {}}};
  const BestPoint best = best_point(states, 10.0);
  EXPECT_NEAR(best.x_mm, 6.5 / 0.17, 1e-12);
  ASSERT_EQ(best.error_um.size(), 2u);
  EXPECT_NEAR(best.error_um[0], 5.0 - 0.65 / 0.17, 1e-12);
  EXPECT_NEAR(best.error_um[1], 15.0 - 2.6 / 0.17, 1e-12);
  EXPECT_NEAR(best.misplaced_um_per_mm, 0.4, 1e-12);
  EXPECT_NEAR(best.rms_um, std::sqrt(0.5 * (1.1764706 * 1.1764706 + 0.2941176 * 0.2941176)), 1e-6);
}

TEST(best_point, of_one_state_is_a_mean_point) {
  const std::vector<TemperatureProfile> states{{{0, 40, 80}, {20, 40, 20}, {}}};
  const BestPoint best = best_point(states, 11.7);
  EXPECT_DOUBLE_EQ(best.x_mm, 20.0);
  EXPECT_DOUBLE_EQ(best.rms_um, 0.0);
}

TEST(mean_point, bad_profiles_and_what_is_said) {
  const std::pair<TemperatureProfile, const char*> table[] = {
      {{{1}, {2}, {}}, "a temperature along x needs at least two places and as many temperatures; there are 1 and 1"},
      {{{1, 2}, {2}, {}},
       "a temperature along x needs at least two places and as many temperatures; there are 2 and 1"},
      {{{1, 1}, {2, 3}, {}},
       "the places of a temperature along x must rise by at least 1e-06 mm; found 1 mm after 1 mm"},
      {{{1, 2}, {2, NAN}, {}},
       "a temperature along x must be finite, within 1e+06 degC and 1e+06 mm of 0; found nan degC at 2 mm"},
      {{{-1e308, 1e308}, {1, 2}, {}},
       "a temperature along x must be finite, within 1e+06 degC and 1e+06 mm of 0; found 1 degC at -1e+308 mm"},
      {{{1, 2}, {2, 1e308}, {}},
       "a temperature along x must be finite, within 1e+06 degC and 1e+06 mm of 0; found 1e+308 degC at 2 mm"},
      {{{0, 1e-320}, {1, 2}, {}},
       "the places of a temperature along x must rise by at least 1e-06 mm; found 1e-320 mm after 0 mm"},
      {{{1, 2}, {2, 3}, {0.1, 1e308}},
       "the sigma of a temperature along x must be 0 to 1e+06 degC; found 1e+308 degC at 2 mm"}};
  for (const auto& [profile, message] : table) {
    try {
      mean_degC(profile);
      ADD_FAILURE() << message;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), message);
    }
  }
  EXPECT_THROW(best_point({}, 1.0), Error);
  const std::vector<TemperatureProfile> apart{{{0, 1}, {1, 2}, {}}, {{1, 2}, {1, 2}, {}}};
  EXPECT_THROW(best_point(apart, 1.0), Error);
}

}  // namespace
}  // namespace ballbar
