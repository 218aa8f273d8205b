#include <gtest/gtest.h>

#include "ballbar/formats/recordings/stored_errors.hpp"

namespace ballbar {
namespace {

TEST(stored_circles, are_those_of_runs_that_store_centre_and_radius) {
  B5r test;
  test.plane = Plane::YZ;
  test.nominal_length_mm = 150.0;
  test.started_s = 7;
  test.run_results = {{"run 0", Direction::CW, std::nullopt}, {"run 1", std::nullopt, std::nullopt}};
  test.stored = {{"run 0", "AF_CENTRE_OFFSET_A", "UT_LENGTH_MM", 0.0123},
                 {"run 0", "AF_CENTRE_OFFSET_B", "UT_LENGTH_MM", -0.0045},
                 {"run 0", "AF_BEST_RADIUS", "UT_LENGTH_MM", 150.0061},
                 {"run 1", "AF_CENTRE_OFFSET_A", "UT_LENGTH_MM", 0.0123}};
  const std::vector<StoredCircle> circles = stored_circles(test);
  ASSERT_EQ(circles.size(), 1u);
  const auto& [recording, circle] = circles.front();
  EXPECT_EQ(recording.plane, Plane::YZ);
  EXPECT_EQ(recording.direction, Direction::CW);
  EXPECT_EQ(recording.started_s, 7);
  EXPECT_TRUE(recording.length_mm.empty());
  EXPECT_NEAR(circle.centre_a_um, 12.3, 1e-9);
  EXPECT_NEAR(circle.centre_b_um, -4.5, 1e-9);
  EXPECT_EQ(circle.radius_mm, 150.0061);
  EXPECT_TRUE(circle.covariance_um2.array().isNaN().all());
}

}  // namespace
}  // namespace ballbar
