#include "ballbar/formats/recordings/limits.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace ballbar {
namespace {

const std::vector<Limit> kLimits = {
    {"RUN_SPEC", "AF_OFFSET_A", "UT_LENGTH_MM", "WARNING", -0.1, 0.1},
    {"RUN_SPEC", "AF_OFFSET_A", "UT_LENGTH_MM", "ERROR", std::nullopt, 0.2},
    {"RUN_SPEC", "AF_FEEDRATE", "UT_FEEDRATE", "WARNING", 900.0, 1100.0},
    {"RENISHAW_DIAGNOSTICS", "AF_CIRCULARITY", "UT_LENGTH_UM", "ERROR", std::nullopt, 10.0},
    {"RUN_SPEC", "AF_CIRCULARITY", "UT_LENGTH_MM", "WARNING", std::nullopt, 0.005},
    {"RUN_SPEC", "AF_SQUARENESS", "UT_SQUARENESS", "WARNING", -20.0, std::nullopt},
};

TEST(limits, value_is_held_against_those_of_its_name) {
  const auto offset_mm = [](double value) { return judged(kLimits, "AF_CENTRE_OFFSET_A", value, "UT_LENGTH_MM"); };
  EXPECT_EQ(offset_mm(0.0488), Judgement::pass);
  EXPECT_EQ(offset_mm(0.1), Judgement::pass);  // on the limit
  EXPECT_EQ(offset_mm(0.1001), Judgement::warning);
  EXPECT_EQ(offset_mm(-0.3), Judgement::warning);  // the second limit has no lower end
  EXPECT_EQ(offset_mm(0.2001), Judgement::fail);
  EXPECT_EQ(judged(kLimits, "AF_OFFSET_A", 0.15, "UT_LENGTH_MM"), Judgement::warning);
  EXPECT_EQ(judged(kLimits, "AF_CALCULATED_FEEDRATE", 1493.2, "UT_FEEDRATE"), Judgement::warning);
  EXPECT_EQ(judged(kLimits, "AF_SQUARENESS", -20.1, "UT_SQUARENESS"), Judgement::warning);
  EXPECT_EQ(judged(kLimits, "AF_SQUARENESS", 1000.0, "UT_SQUARENESS"), Judgement::pass);
}

TEST(limits, are_converted_to_the_unit_of_the_value) {
  EXPECT_EQ(judged(kLimits, "AF_CENTRE_OFFSET_A", 48.8, "UT_LENGTH_UM"), Judgement::pass);
  EXPECT_EQ(judged(kLimits, "AF_CENTRE_OFFSET_A", 100.0, "UT_LENGTH_UM"), Judgement::pass);
  EXPECT_EQ(judged(kLimits, "AF_CENTRE_OFFSET_A", 100.1, "UT_LENGTH_UM"), Judgement::warning);
  EXPECT_EQ(judged(kLimits, "AF_CIRCULARITY", 0.0101, "UT_LENGTH_MM"), Judgement::fail);
  EXPECT_EQ(judged(kLimits, "AF_CIRCULARITY", 5.1, "UT_LENGTH_UM"), Judgement::warning);
  // 0.00007 mm times 1e3 is 0.06999999999999999: no excess.
  const std::vector<Limit> fine = {{"RUN_SPEC", "A", "UT_LENGTH_MM", "WARNING", -0.00007, 0.00007}};
  EXPECT_EQ(judged(fine, "A", 0.07, "UT_LENGTH_UM"), Judgement::pass);
  EXPECT_EQ(judged(fine, "A", -0.07, "UT_LENGTH_UM"), Judgement::pass);
  EXPECT_EQ(judged(fine, "A", 0.0701, "UT_LENGTH_UM"), Judgement::warning);
}

TEST(limits, of_another_parent_name_or_unit_say_nothing) {
  EXPECT_EQ(judged(kLimits, "AF_CIRCULARITY", 20.0, "UT_LENGTH_UM", "RUN_SPEC"), Judgement::warning);
  EXPECT_EQ(judged(kLimits, "AF_CIRCULARITY", 20.0, "UT_LENGTH_UM", "RENISHAW_DIAGNOSTICS"), Judgement::fail);
  EXPECT_EQ(judged(kLimits, "AF_CIRCULARITY", 20.0, "UT_LENGTH_UM", "ISO230_4"), std::nullopt);
  EXPECT_EQ(judged(kLimits, "AF_CIRCULARITY", 20.0, "UT_PERCENT"), std::nullopt);
  EXPECT_EQ(judged(kLimits, "AF_CENTRE_OFFSET_B", 1.0, "UT_LENGTH_MM"), std::nullopt);
  EXPECT_EQ(judged(kLimits, "AF_SQUARENESS", std::numeric_limits<double>::quiet_NaN(), "UT_SQUARENESS"), std::nullopt);
  EXPECT_EQ(judged({}, "AF_SQUARENESS", 1.0, "UT_SQUARENESS"), std::nullopt);
}

TEST(limits, judgements_have_names) {
  EXPECT_EQ(name_of(Judgement::pass), "pass");
  EXPECT_EQ(name_of(Judgement::warning), "warning");
  EXPECT_EQ(name_of(Judgement::fail), "fail");
}

// In um: 10 of the one, 5 of the other, which is the narrower.
TEST(limits, the_range_is_the_narrowest_of_all_in_one_unit) {
  const LimitRange circularity = range_of(kLimits, "AF_CIRCULARITY", "UT_LENGTH_UM");
  EXPECT_FALSE(circularity.lower);
  EXPECT_DOUBLE_EQ(circularity.upper.value_or(0.0), 5.0);
  const LimitRange offset = range_of(kLimits, "AF_CENTRE_OFFSET_A", "UT_LENGTH_MM");
  EXPECT_EQ(offset.lower, -0.1);
  EXPECT_EQ(offset.upper, 0.1);
  EXPECT_FALSE(range_of(kLimits, "AF_OTHER", "UT_LENGTH_MM").upper);
}

}  // namespace
}  // namespace ballbar
