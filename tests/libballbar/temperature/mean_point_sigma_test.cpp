#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/temperature/temperature.hpp"

namespace ballbar {
namespace {

// T = 40 - x / 10 over 100 mm: 35 at x = 50, slope -0.1.
TemperatureProfile line(double sigma_degC) { return {{0, 100}, {40, 30}, {sigma_degC, sigma_degC}}; }

TEST(mean_point_sigma, crossings_within_two_sigma_are_one) {
  EXPECT_DOUBLE_EQ(same_degC(line(0.2), 35.0), 0.4);
  EXPECT_EQ(same_degC(line(0.2), 50.0), 0.0) << "nowhere so hot";
  EXPECT_EQ(same_degC({{0, 100}, {40, 30}, {}}, 35.0), 0.0);
}

// 0.3 sqrt(12) in steps is 0.3 of standard uncertainty: hypot(0.4, 0.3) = 0.5.
TEST(mean_point_sigma, a_scale_read_in_steps_adds_to_it) {
  const TemperatureProfile profile = with_step(line(0.4), 0.3 * std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(profile.sigma_degC[0], 0.5);
  EXPECT_DOUBLE_EQ(profile.sigma_degC[1], 0.5);
  EXPECT_TRUE(with_step({{0, 100}, {40, 30}, {}}, 1.0).sigma_degC.empty());
}

// 0.4 degC over 0.1 degC/mm is 4 mm; with 3 mm of the edges 5 mm, with a stretch of 24 mm 13 mm.
TEST(mean_point_sigma, of_the_place) {
  MeanPoint point = mean_points(line(0.4)).front();
  EXPECT_NEAR(sigma_of_place_mm(line(0.4), point, 0.0), 4.0, 1e-12);
  EXPECT_NEAR(sigma_of_place_mm(line(0.4), point, 3.0), 5.0, 1e-12);
  point.from_mm -= 12.0;
  point.to_mm += 12.0;
  EXPECT_NEAR(sigma_of_place_mm(line(0.4), point, 3.0), 13.0, 1e-12);
  EXPECT_TRUE(std::isnan(sigma_of_place_mm({{0, 100}, {40, 30}, {}}, point, 3.0)));
}

TEST(mean_point_sigma, flattest_first_whatever_its_sign) {
  MeanPoint steep, flat, falling;
  steep.slope_degC_per_mm = 0.5;
  falling.slope_degC_per_mm = -0.2;
  flat.slope_degC_per_mm = 0.1;
  const std::vector<MeanPoint> points = flattest_first({steep, falling, flat});
  EXPECT_EQ(points[0].slope_degC_per_mm, 0.1);
  EXPECT_EQ(points[1].slope_degC_per_mm, -0.2);
  EXPECT_EQ(points[2].slope_degC_per_mm, 0.5);
}

}  // namespace
}  // namespace ballbar
