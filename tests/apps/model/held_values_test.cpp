#include "model/held_values.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

Model drift() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_a_degC"}), term_of("lagged_expansion", {"T_b_degC"})};
  return model;
}

const Setting& setting_of(const Model& model, std::size_t term, std::string_view parameter) {
  const auto& parameters = model.terms[term].effect->parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].name == parameter) return model.terms[term].settings[k];
  }
  throw Error("no such parameter");
}

TEST(HeldValues, OneParameterIsHeldAndNoOther) {
  const Model model = with_held_values(drift(), {"lagged_expansion(T_b_degC).time_constant_s=1.5e3"});
  EXPECT_TRUE(setting_of(model, 1, "time_constant_s").held);
  EXPECT_EQ(setting_of(model, 1, "time_constant_s").start, 1500.0);
  EXPECT_FALSE(setting_of(model, 1, "gain_um_per_K").held);
  EXPECT_FALSE(setting_of(model, 0, "gain_um_per_K").held);
  EXPECT_FALSE(model.constant_um);
}

TEST(HeldValues, TheConstantToo) {
  EXPECT_EQ(with_held_values(drift(), {"constant.constant_um=-2"}).constant_um, -2.0);
  Model recording;
  recording.level = Level::recording;
  EXPECT_THROW(with_held_values(recording, {"constant.constant_um=1"}), Error);
}

TEST(HeldValues, WhatIsNoneIsSaid) {
  const std::pair<std::string, std::string> table[] = {
      {"expansion", "--set: expected EFFECT.PARAMETER=VALUE, found \"expansion\"."},
      {".gain_um_per_K=1", "--set: expected EFFECT.PARAMETER=VALUE, found \".gain_um_per_K=1\"."},
      {"expansion(T_a_degC).=1", "--set: expected EFFECT.PARAMETER=VALUE, found \"expansion(T_a_degC).=1\"."},
      {"expansion(T_a_degC).gain_um_per_K=nan",
       "--set: expected a number behind the sign =, found \"expansion(T_a_degC).gain_um_per_K=nan\"."},
      {"expansion(T_a_degC).gain_um_per_K=1x",
       "--set: expected a number behind the sign =, found \"expansion(T_a_degC).gain_um_per_K=1x\"."},
      {"expansion(T_a_degC).gain=1",
       "--set: expected a parameter of expansion(T_a_degC) of the model, found \"gain\"; the nearest is "
       "gain_um_per_K."},
      {"expansion(T_c_degC).gain_um_per_K=1",
       "--set: expected an effect of the model, found \"expansion(T_c_degC)\"; the nearest is expansion(T_a_degC)."}};
  for (const auto& [setting, sentence] : table) {
    try {
      with_held_values(drift(), {setting});
      FAIL() << setting;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), sentence);
    }
  }
}

}  // namespace
}  // namespace ballbar
