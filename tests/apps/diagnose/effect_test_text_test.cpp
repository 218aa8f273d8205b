// The test of an effect, in words.
#include "diagnose/effect_test_text.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace ballbar {
namespace {

TEST(EffectTestText, of_a_freed_parameter) {
  Candidate candidate;
  candidate.bound.effect = find_effect("expansion", Level::series);
  candidate.label = "expansion(T1_degC)";
  candidate.doubts = {Doubt::weak_evidence};
  EffectTest effect_test;
  effect_test.added.push_back(std::move(candidate));
  EXPECT_EQ(freed_text(effect_test), "");
  EXPECT_EQ(
      text_of(conclusion(effect_test)),
      "The data do not support expansion(T1_degC). The remaining error stays at 0 um. Why not: the evidence for it "
      "is weak.");
  effect_test.freed = FreedParameter{"speed_heating(speed_rpm)", "time_constant_s"};
  EXPECT_EQ(freed_text(effect_test), "time_constant_s of speed_heating(speed_rpm)");
  EXPECT_EQ(
      text_of(conclusion(effect_test)),
      "The data do not support expansion(T1_degC). The remaining error stays at 0 um. The test and the amplitude "
      "assume another time_constant_s of speed_heating(speed_rpm) than the model holds. Why not: the evidence for "
      "it is weak.");
}

}  // namespace
}  // namespace ballbar
