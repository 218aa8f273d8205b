// What counts as right and as wrong, and how it is counted.
#include <gtest/gtest.h>

#include <utility>

#include "tally.hpp"

namespace ballbar::verdicts {
namespace {

Said said(Word word, std::vector<Member> named) {
  Said result;
  result.word = word;
  result.named = std::move(named);
  return result;
}

TEST(Judged, NamesAreRightOrWrong) {
  Made set;
  set.truths = {{"gradient_bending", {"a_degC", "b_degC"}, {{"gain_um_per_K", 2.0, true}}}};
  set.drivers = {"a_degC", "b_degC"};
  EXPECT_TRUE(judged(set, said(Word::named, {{"gradient_bending", {"b_degC", "a_degC"}}})).right);
  EXPECT_TRUE(judged(set, said(Word::named, {{"gradient_bending", {"b_degC", "a_degC"}}})).driver_right);
  EXPECT_FALSE(judged(set, said(Word::equivalent, {{"gradient_bending", {"b_degC", "a_degC"}}})).right);
  EXPECT_TRUE(judged(set, said(Word::named, {{"expansion", {"a_degC"}}})).wrong);
  EXPECT_TRUE(judged(set, said(Word::nothing, {})).nothing_said);
  Said turned = said(Word::named, {{"gradient_bending", {"b_degC", "a_degC"}}});
  turned.intervals = {{turned.named.front(), "gain_um_per_K", -2.1, -2.5, -1.9}};
  ASSERT_EQ(judged(set, turned).covered.size(), 1U);
  EXPECT_TRUE(judged(set, turned).covered.front().covers);
}

TEST(Judged, OutsideADriverIsRightOrWrong) {
  Made set;
  set.is_outside = true;
  set.drivers = {"a_degC"};
  EXPECT_TRUE(judged(set, said(Word::unexplained, {})).right);
  Said driver = said(Word::driver, {});
  driver.drivers = {{"a_degC", 0.95}, {"b_degC", 0.5}};
  EXPECT_TRUE(judged(set, driver).right);
  driver.drivers.back().p = 0.95;
  EXPECT_TRUE(judged(set, driver).wrong);
  EXPECT_TRUE(judged(set, said(Word::named, {{"expansion", {"a_degC"}}})).wrong);
  EXPECT_TRUE(judged(set, said(Word::equivalent, {})).undecided);
}

TEST(Judged, OwnValuesAreRightOrWrong) {
  Made set;
  set.own = OwnTruth{"speed_heating(n_rpm)", "exponent", 5.0 / 3.0, 1.0};
  Said own = said(Word::named, {});
  own.own = {{"speed_heating(n_rpm)", "exponent", 5.0 / 3.0, 1.02, 0.97}};
  EXPECT_TRUE(judged(set, own).right);
  own.own.front().p = 0.7;
  EXPECT_FALSE(judged(set, own).right);
  own.own.front() = {"speed_heating(n_rpm)", "time_constant_s", 900.0, 300.0, 0.97};
  EXPECT_TRUE(judged(set, own).wrong);
}

// 0 and 5 of 10: Wilson 1927, worked by hand with z = 1.959964.
TEST(Tally, WilsonIntervals) {
  EXPECT_NEAR(wilson(0, 10).high, 0.27753, 1e-5);
  EXPECT_NEAR(wilson(5, 10).low, 0.23659, 1e-5);
  EXPECT_NEAR(wilson(5, 10).high, 0.76341, 1e-5);
}

TEST(Tally, ProbabilitiesAreComparedWithWhatIsTrue) {
  Judged set;
  for (int k = 0; k < 20; ++k) set.stated.push_back({0.95, k < 10});
  set.stated.push_back({0.5, true});
  set.covered = {{true, true}, {true, false}, {false, true}};
  EXPECT_EQ(reliability({set}),
            "P stated of an effect    count  of them true\n"
            "0.5 to 0.6, mean 0.500      1    100.0 (20.7-100.0)\n"
            "0.9 to 1.0, mean 0.950     20      50.0 (29.9-70.1)  outside\n");
  EXPECT_EQ(coverage({set}),
            "95 % intervals of rightly named effects hold 50.0 (9.5-90.5) % of 2 gains, 100.0 (20.7-100.0) % of 1 "
            "shapes; 92 to 97\n");
}

}  // namespace
}  // namespace ballbar::verdicts
