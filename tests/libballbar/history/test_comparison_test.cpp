#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/history/errors_change.hpp"

namespace ballbar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

MachineTest test_of(double play_um, double circularity_um, double sigma_um = 0.1) {
  MachineTest test;
  test.feed_mm_per_min = 1000.0;
  test.directions = {Direction::CCW, Direction::CW};
  test.quantities = {{"centre_a", "um", 7.0 * play_um, sigma_um, true},
                     {"squareness", "um/m", 3.0, sigma_um, false, false},
                     {"backlash_a_pos", "um", play_um, sigma_um},
                     {"backlash_a_neg", "um", 0.5 * play_um, sigma_um},
                     {"circularity", "um", circularity_um, sigma_um}};
  return test;
}

std::vector<std::string> names_of(const TestComparison& comparison) {
  std::vector<std::string> names;
  for (const QuantityDifference& one : comparison.quantities) names.push_back(one.name);
  return names;
}

// d = 1.2 - 8.1 = -6.9; sigma_d = hypot(0.1, 0.2) = 0.2236.
TEST(test_comparison, difference_with_its_sigma) {
  const TestComparison comparison = compared_tests(test_of(8.1, 9.0, 0.1), test_of(1.2, 9.0, 0.2));
  EXPECT_EQ(names_of(comparison),
            (std::vector<std::string>{"circularity", "backlash_a_pos", "backlash_a_neg", "centre_a", "squareness"}));
  const QuantityDifference& play = comparison.quantities[1];
  EXPECT_NEAR(play.difference, -6.9, 1e-12);
  EXPECT_NEAR(play.sigma, 0.22360679775, 1e-10);
  EXPECT_EQ(play.clear, true);
  EXPECT_EQ(comparison.quantities[0].clear, false);
  EXPECT_EQ(comparison.judged, 4u);
}

// Both ends of an error are one change; where the bar was put is none.
TEST(test_comparison, changes_are_of_errors) {
  const auto changes = clear_changes(compared_tests(test_of(8.1, 9.0), test_of(1.2, 4.0)));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].name, "backlash_a");
  EXPECT_EQ(changes[0].before, 8.1);
  EXPECT_EQ(changes[0].after, 1.2);
}

// Of ten quantities p = 0.05 / 10 is needed, 2.81 sigma: 2.7 sigma are none, which would be clear of one alone; 2.9
// are.
TEST(test_comparison, holm_over_all_quantities) {
  MachineTest before, after;
  for (int k = 0; k < 10; ++k) {
    before.quantities.push_back({"q" + std::to_string(k), "um", 0.0, 0.0});
    after.quantities.push_back({"q" + std::to_string(k), "um", k == 0 ? 2.7 : 0.0, 1.0});
  }
  EXPECT_EQ(compared_tests(before, after).quantities[0].clear, false);
  after.quantities[0].value = 2.9;
  EXPECT_EQ(compared_tests(before, after).quantities[0].clear, true);
}

TEST(test_comparison, stored_values_have_no_sigma) {
  MachineTest stored = test_of(8.1, 9.0, kNaN);
  stored.stored = true;
  const TestComparison comparison = compared_tests(stored, test_of(1.2, 4.0));
  for (const QuantityDifference& one : comparison.quantities) EXPECT_FALSE(one.clear.has_value()) << one.name;
  EXPECT_EQ(comparison.differs, std::vector<TestCondition>{TestCondition::stored});
  EXPECT_EQ(comparison.judged, 0u);
}

TEST(test_comparison, what_is_in_one_test_alone) {
  MachineTest after = test_of(1.0, 4.0);
  after.quantities.push_back({"lateral_play_a_pos", "um", 2.0, 0.1});
  const TestComparison comparison = compared_tests(test_of(1.0, 4.0), after);
  const QuantityDifference& last = comparison.quantities.back();
  EXPECT_EQ(last.name, "lateral_play_a_pos");
  EXPECT_TRUE(std::isnan(last.before));
  EXPECT_TRUE(std::isnan(last.difference));
  EXPECT_FALSE(last.clear.has_value());
}

TEST(test_comparison, what_the_tests_were_made_with) {
  const MachineTest before = test_of(1.0, 4.0);
  MachineTest after = before;
  after.nominal_length_mm = 150.0;
  after.arc_deg = 220.0;
  after.feed_mm_per_min = 1100.0;
  after.directions = {Direction::CW};
  after.bar = "K2";  // the first states none
  const std::vector<TestCondition> expected{TestCondition::nominal_length, TestCondition::arc, TestCondition::feed,
                                            TestCondition::directions};
  EXPECT_EQ(differing_conditions(before, after), expected);
  after = before;
  after.start_deg = 180.0;  // of a full circle
  after.feed_mm_per_min = 1049.0;
  after.directions = {Direction::CW, Direction::CCW};
  EXPECT_TRUE(differing_conditions(before, after).empty());
}

TEST(test_comparison, two_planes_are_no_before_and_after) {
  MachineTest after = test_of(1.0, 4.0);
  after.plane = Plane::YZ;
  try {
    compared_tests(test_of(1.0, 4.0), after);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "expected two tests of one plane, found XY and YZ. Use `ballbar history` for tests of different planes.");
  }
}

}  // namespace
}  // namespace ballbar
