#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "ballbar/drift/thermal_test.hpp"

namespace ballbar {
namespace {

struct Readings {
  std::vector<double> time_s, value_um;
};

// A reading every `step_s`, with normal noise.
template <class Curve>
Readings readings_of(std::size_t n, double step_s, double noise_um, unsigned seed, Curve curve) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, noise_um);
  Readings readings;
  for (std::size_t i = 0; i < n; ++i) {
    readings.time_s.push_back(static_cast<double>(i) * step_s);
    readings.value_um.push_back(curve(readings.time_s.back()) + noise(random));
  }
  return readings;
}

Course course_of(const Readings& readings) { return *ballbar::course_of(readings.time_s, readings.value_um); }

TEST(Course, wear_is_a_trend) {
  int within = 0, trends = 0, steps = 0;
  constexpr int kSeeds = 100;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Course course = course_of(readings_of(60, 480.0, 0.6, seed, [](double t) { return -1.1 * t / 3600.0; }));
    within += std::abs(course.trend_um_per_h.value_um + 1.1) <= 2.0 * course.trend_um_per_h.sigma_um ? 1 : 0;
    trends += course.shape == CourseShape::trend ? 1 : 0;
    steps += static_cast<int>(course.steps.size());
  }
  EXPECT_GE(within, 88);
  EXPECT_GE(trends, 90);
  EXPECT_LE(steps, 5);
}

TEST(Course, noise_alone_is_still_and_has_no_step) {
  int still = 0, steps = 0;
  constexpr int kSeeds = 100;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Course course = course_of(readings_of(50, 540.0, 1.0, seed, [](double) { return 40000.0; }));
    still += course.shape == CourseShape::still ? 1 : 0;
    steps += static_cast<int>(course.steps.size());
  }
  EXPECT_GE(still, 88);
  EXPECT_LE(steps, 5);
}

TEST(Course, a_correction_of_the_offset_is_a_step_beside_the_wear) {
  int found = 0;
  constexpr int kSeeds = 50;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Course course = course_of(
        readings_of(80, 360.0, 0.9, seed, [](double t) { return 2.2 * t / 3600.0 - (t >= 16020.0 ? 9.5 : 0.0); }));
    if (course.steps.size() != 1 || course.shape != CourseShape::trend) continue;
    const CourseStep& step = course.steps.front();
    found += std::abs(step.time_s - 16020.0) <= 720.0 && std::abs(step.size.value_um + 9.5) <= 3.0 * step.size.sigma_um
                 ? 1
                 : 0;
  }
  EXPECT_GE(found, 45);
}

TEST(Course, warming_up_settles) {
  int settles = 0, within = 0;
  constexpr int kSeeds = 50;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Course course =
        course_of(readings_of(48, 600.0, 0.8, seed, [](double t) { return 14.0 * std::exp(-t / 3300.0); }));
    settles += course.shape == CourseShape::decay && course.steps.empty() ? 1 : 0;
    within += std::abs(course.decay.value_um + 14.0) <= 3.0 * course.decay.sigma_um ? 1 : 0;
  }
  EXPECT_GE(settles, 45);
  EXPECT_GE(within, 45);
}

TEST(Course, two_corrections_of_the_offset_are_two_steps) {
  int found = 0;
  constexpr int kSeeds = 30;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Course course = course_of(readings_of(80, 360.0, 0.6, seed, [](double t) {
      return 1.5 * t / 3600.0 - (t >= 11160.0 ? 6.0 : 0.0) - (t >= 20160.0 ? 5.0 : 0.0);
    }));
    found += course.shape == CourseShape::trend && course.steps.size() == 2 &&
                     std::abs(course.trend_um_per_h.value_um - 1.5) < 0.3
                 ? 1
                 : 0;
  }
  EXPECT_GE(found, 27);
}

// A day's cycle is no trend, no curve that settles and no step.
TEST(Course, a_cycle_has_none_of_the_shapes) {
  const Course course =
      course_of(readings_of(288, 300.0, 0.3, 1, [](double t) { return 10.0 * std::sin(2.0 * 3.14159 * t / 86400.0); }));
  EXPECT_EQ(course.shape, CourseShape::none);
  EXPECT_NEAR(course.noise_um, 0.3, 0.06);
  EXPECT_GT(course.left_um, 1.0);
}

TEST(Course, needs_eight_readings) {
  EXPECT_FALSE(ballbar::course_of(std::vector<double>{0, 1, 2, 3, 4, 5, 6}, std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace ballbar
