#include "ballbar/internal/model/recording_base_model.hpp"

#include <gtest/gtest.h>

#include "../diagnosis/made_recordings.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

Model servo() {
  Model model;
  model.level = Level::recording;
  model.targets = {"deviation_um"};
  model.terms = {term_of("servo_mismatch", {}, Level::recording)};
  return model;
}

TEST(circle_model, circles_stand_before_the_effects_of_a_model_once) {
  const Series trace = made::circles({});  // CCW and CW
  const Model model = with_circles(servo(), trace);
  ASSERT_EQ(model.terms.size(), 3u);
  EXPECT_EQ(label_of(model.terms[0]), "circle 1");
  EXPECT_EQ(label_of(model.terms[1]), "circle 2");
  EXPECT_EQ(model.terms[2].effect->name, "servo_mismatch");
  EXPECT_EQ(with_circles(model, trace).terms.size(), 3u);
}

TEST(circle_model, an_effect_that_does_not_act_there_is_named) {
  EXPECT_NO_THROW(expect_acts(servo(), Motion::linear_axes));
  try {
    expect_acts(servo(), Motion::spindle);
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "expected effects that act where spindle drives the circle, found servo_mismatch.");
  }
}

}  // namespace
}  // namespace ballbar
