#include "errors/stored_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ballbar {
namespace {

constexpr const char* kParent = "RENISHAW_DIAGNOSTICS 2.1";

B5r stored_results() {
  B5r test;
  test.plane = Plane::YZ;
  test.started_s = 5000;
  test.start_deg = 250.0;
  test.end_deg = 110.0;
  test.programmed_feed_mm_per_min = 1000.0;
  test.stored = {{"run 0", "AF_CIRCULARITY", "UT_LENGTH_MM", 0.0060},
                 {kParent, "AF_CIRCULARITY", "UT_LENGTH_UM", 6.5},
                 {kParent, "AF_CALCULATED_FEEDRATE", "UT_FEEDRATE", 1003.0},
                 {kParent, "AF_CYCLIC_PITCH_A", "UT_LENGTH_MM", 16.0},
                 {kParent, "AF_CYCLIC_ERROR_A_FWD", "UT_LENGTH_UM", 0.8},
                 {kParent, "AF_CENTRE_OFFSET_A", "UT_LENGTH_UM", 48.8},
                 {kParent, "AF_GLOBAL_SCALE", "UT_LENGTH_UM", 1.3},
                 {kParent, "AF_SQUARENESS", "UT_SQUARENESS", -10.3},
                 {kParent, "AF_SCALE_ERROR_A", "UT_SCALE_ERROR", 40.4},
                 {kParent, "AF_SCALE_ERROR_B", "UT_SCALE_ERROR", 10.3},
                 {kParent, "AF_BEST_RADIUS", "UT_LENGTH_MM", 50.0013},
                 {kParent, "AF_BACKLASH_A_GLOBAL", "UT_LENGTH_UM", -0.9},
                 {kParent, "AF_BACKLASH_A_MISMATCH", "UT_LENGTH_UM", 0.0},
                 {kParent, "AF_BACKLASH_A_POS", "UT_LENGTH_UM", -0.9},
                 {kParent, "AF_BACKLASH_A_NEG", "UT_LENGTH_UM", -0.8, false},
                 {kParent, "AF_SERVO_MISMATCH", "UT_SERVO_MISMATCH", 0.02},
                 {kParent, "AF_REVERSAL_SPIKES_A_POS", "UT_LENGTH_UM", -0.2},
                 {kParent, "AF_SQUARENESS_RANK", "UT_RANKING", 6.0},
                 {kParent, "AF_SQUARENESS_IC", "UT_LENGTH_UM", 0.5}};
  return test;
}

TEST(stored_test, names_and_units_are_those_of_the_fit) {
  const MachineTest test = stored_test(stored_results());
  std::vector<std::string> found;
  for (const TestQuantity& quantity : test.quantities) {
    found.push_back(quantity.name + " " + quantity.unit);
    EXPECT_TRUE(std::isnan(quantity.sigma));
  }
  const std::vector<std::string> expected{
      "circularity um", "cyclic_error_a_fwd um", "centre_a um",       "global_scale um",   "squareness um/m",
      "scale_y um/m",   "scale_z um/m",          "backlash_a_pos um", "servo_mismatch ms", "reversal_spike_a_pos um"};
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(test.stored);
  EXPECT_TRUE(test.quantities[2].of_set_up);
  EXPECT_EQ(test.feed_mm_per_min, 1003.0);
  EXPECT_EQ(test.start_deg, 250.0);
  EXPECT_EQ(test.arc_deg, 220.0);
  ASSERT_TRUE(test.scales);
  EXPECT_EQ(test.scales->a_ppm, 40.4);
  EXPECT_EQ(test.scales->b_ppm, 10.3);
  ASSERT_TRUE(test.squareness);
  EXPECT_EQ(test.squareness->value, -10.3);
}

TEST(stored_test, limits_that_fail_go_before_those_that_warn) {
  B5r test;
  test.limits = {{"RENISHAW_DIAGNOSTICS", "AF_SQUARENESS", "UT_SQUARENESS", "WARNING", -20.0, 20.0},
                 {"RENISHAW_DIAGNOSTICS", "AF_SQUARENESS", "UT_SQUARENESS", "FAIL", -30.0, 30.0},
                 {"RENISHAW_DIAGNOSTICS", "AF_CIRCULARITY", "UT_LENGTH_MM", "FAIL", {}, 0.0125},
                 {"RUN_SPEC", "AF_OFFSET_A", "UT_LENGTH_MM", "WARNING", -0.1, 0.1},
                 {"RUN_SPEC", "AF_FEEDRATE", "UT_FEEDRATE", "WARNING", 900.0, 1100.0}};
  const auto tolerances = stated_tolerances(test);
  ASSERT_EQ(tolerances.size(), 2u);
  EXPECT_EQ(tolerances[0].upper, 30.0);
  EXPECT_EQ(tolerances[1].quantity, "circularity");
  EXPECT_FALSE(tolerances[1].lower);
  EXPECT_EQ(tolerances[1].upper, 12.5);
}

}  // namespace
}  // namespace ballbar
