// Why effects are not testable, in words.
#include "model/testability_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace ballbar {
namespace {

Detectability untestable(Testability testability, Deficiency deficiency = {}, const std::string& name = "expansion") {
  Detectability one;
  one.effect = find_effect(name, Level::series);
  one.testability = testability;
  one.deficiency = std::move(deficiency);
  return one;
}

std::string reason_text(const Detectability& untestable) { return text_of(reason_of(untestable)); }

TEST(TestabilityText, of_each_reason) {
  EXPECT_EQ(reason_text(untestable(Testability::input_constant)), "its input does not change");
  EXPECT_EQ(reason_text(untestable(Testability::input_constant, {.has_gaps = true})), "its input has gaps");
  EXPECT_EQ(reason_text(untestable(Testability::absorbed)), "what it adds is made by the model already");
  EXPECT_EQ(reason_text(untestable(Testability::in_the_model)), "it is in the model");
  EXPECT_EQ(reason_text(untestable(Testability::other_motion, {.motion = Motion::rotary_axis})),
            "it is not one of circles driven by rotary_axis");
  EXPECT_EQ(reason_text(untestable(Testability::no_clock)), "it needs a clock, and the rows are numbered");
  EXPECT_EQ(reason_text(untestable(Testability::rows_too_far_apart, {.step_s = 480.0, .period_s = 900.0})),
            "rows 8 min apart do not show a period of 15 min");
}

TEST(TestabilityText, of_missing_inputs) {
  const auto text = [](Deficiency deficiency) {
    return reason_text(untestable(Testability::input_missing, std::move(deficiency)));
  };
  EXPECT_EQ(text({.missing_inputs = {{"speed", {"rpm"}}}}), "no column for speed (rpm)");
  EXPECT_EQ(text({.missing_inputs = {{"temperature", {"degC", "K"}}, {"input", {}}}}),
            "no column for temperature (degC or K), input (any unit)");
  EXPECT_EQ(text({.none_accepted = "no column of the bar"}), "no column of the bar");
  EXPECT_EQ(text({}), "there are too few columns of the kind");
}

TEST(TestabilityText, effects_of_equal_facts_share_a_reason) {
  const Deficiency no_speed{.missing_inputs = {{"speed", {"rpm"}}}}, no_load{.missing_inputs = {{"load", {"W"}}}};
  const std::vector<Detectability> all = {
      untestable(Testability::input_missing, no_speed, "speed_heating"),
      untestable(Testability::testable),
      untestable(Testability::input_missing, no_load, "settling"),
      untestable(Testability::input_missing, no_speed, "step"),
      untestable(Testability::in_the_model, {}, "linear_drift"),
      untestable(Testability::absorbed, {}, "day_cycle"),
  };
  const auto reasons = by_reason(all, [](Testability testability) {
    return testability != Testability::testable && testability != Testability::in_the_model;
  });
  ASSERT_EQ(reasons.size(), 3u);
  EXPECT_EQ(reasons[0].first, &all[0]);
  EXPECT_EQ(reasons[0].second, (std::vector<std::string>{"speed_heating", "step"}));
  EXPECT_EQ(reasons[1].second, (std::vector<std::string>{"settling"}));
  EXPECT_EQ(reasons[2].second, (std::vector<std::string>{"day_cycle"}));
}

}  // namespace
}  // namespace ballbar
