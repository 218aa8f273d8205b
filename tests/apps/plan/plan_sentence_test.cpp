// Plans in plain words.
#include "plan/plan_sentence.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

BoundEffect effect(const char* name, const std::string& column) { return {find_effect(name, Level::series), {column}}; }

TestPlan with_test(double p_right) {
  TestPlan plan;
  plan.verdict = Verdict::equivalent;
  ExpectedTest test{SpeedProgram::random, 12000.0, 8.0, {{{600.0, 0.0}, {600.0, 9000.0, 2.0, 3.0}}}};
  test.truths = 24;
  test.p_right = test.p_part = p_right;
  test.p_right_sigma = 0.09;
  plan.tests.push_back(test);
  return plan;
}

TEST(plan_sentence, of_a_test_with_all_that_can_be_moved) {
  TestPlan plan = with_test(0.5);
  EXPECT_EQ(text_of(name_of(plan.tests.front())),
            "random speeds, the room 3 K warmer and back, 2 times the load and back");
  plan.tests.front().p_part = 0.75;
  plan.sensor = {effect("speed_heating", "speed_rpm"), 0.9};
  EXPECT_EQ(text_of(sentence_of(plan, 12.0)),
            "Run 8 h from cold: speeds that change every 10 min to 2 h, up to 12 000 rpm; the room 3 K warmer and "
            "back, 2 times the load and back. This run would name everything that is missing in 50 % of cases (± 9 %, "
            "24 simulated), a part of it in 75 %, and something wrong in 0 %. No test of up to 12 h reaches 95 %. A "
            "temperature sensor where speed_heating(speed_rpm) heats would raise it to 90 % in the same run.");
}

TEST(plan_sentence, of_other_tests) {
  ExpectedTest test = with_test(1.0).tests.front();
  test.schedule.dwells = {{600.0, 9000.0}};
  for (const auto& [speeds, name] : {std::pair{SpeedProgram::staircase, "staircase"},
                                     {SpeedProgram::stop_and_go, "stop and go"},
                                     {SpeedProgram::rest, "at rest"}}) {
    test.speeds = speeds;
    EXPECT_EQ(text_of(name_of(test)), name);
  }
  test.schedule.dwells.push_back({600.0, 0.0, 2.0, 0.0, 3.0});
  EXPECT_EQ(text_of(name_of(test)), "at rest, the coolant 3 K warmer and back") << "no load at rest";
}

TEST(plan_sentence, of_effects_that_no_test_separates) {
  TestPlan plan;
  plan.verdict = Verdict::driver;
  plan.inseparable = {{effect("expansion", "T1_degC"), effect("expansion", "T2_degC")},
                      {effect("expansion", "T1_degC"), effect("lagged_expansion", "T1_degC")}};
  EXPECT_EQ(
      text_of(sentence_of(plan, 4.0)),
      "No test can distinguish expansion(T1_degC) and expansion(T2_degC): their columns measure the same quantity. No "
      "test can distinguish expansion(T1_degC) and lagged_expansion(T1_degC): beside this model they add the "
      "same curve. No test is proposed.");
}

TEST(plan_sentence, without_a_test) {
  TestPlan plan;
  plan.obstacle = Obstacle::too_few_values;
  EXPECT_EQ(text_of(sentence_of(plan, 4.0)),
            "The data have too few values, or do not move: nothing can be planned from them.");
  plan.obstacle = Obstacle::none;
  plan.p_nothing = 0.9;
  EXPECT_EQ(text_of(sentence_of(plan, 4.0)), "In these data nothing is missing: there is nothing to decide.");
  plan.p_nothing = 0.6;
  EXPECT_EQ(text_of(sentence_of(plan, 4.0)),
            "Nothing is found to be missing (60 % sure). No test of up to 4 h would find what may still be there.");
  plan.verdict = Verdict::driver;
  EXPECT_EQ(text_of(sentence_of(plan, 4.0)), "No test of up to 4 h would decide. None is proposed.");
  plan.is_decided = true;
  EXPECT_EQ(text_of(sentence_of(plan, 4.0)), "These data already decide: no further test is needed.");
}

TEST(plan_sentence, label_of_a_curve) {
  EXPECT_EQ(label_of(ExpectedCurve{}), "nothing of the catalogue");
  EXPECT_EQ(label_of(ExpectedCurve{{effect("expansion", "T1_degC"), effect("lagged_expansion", "T2_degC")}, 0.5, {}}),
            "expansion(T1_degC) + lagged_expansion(T2_degC)");
}

}  // namespace
}  // namespace ballbar
