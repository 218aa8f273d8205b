#include "ballbar/model/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Series data() {
  Series series;
  series.time_s = {0.0, 10.0, 30.0};
  for (const std::string_view name : {"z_um", "x_um", "T_air_degC", "T_oil_degC", "speed_rpm"}) {
    series.columns.push_back({std::string(name), role_from_unit(unit_of(name)), {1.0, 2.0, 3.0}});
  }
  return series;
}

Model model(std::vector<Term> terms) { return {Level::series, {"z_um"}, std::move(terms), std::nullopt}; }

Term own(std::string_view formula, std::vector<Parameter> parameters = {}) {
  return expression_term(formula, std::move(parameters));
}

Parameter gain(std::string name) {
  return {.name = std::move(name), .unit = "1", .lower = -kInfinity, .upper = kInfinity};
}

std::string complaint(const Model& candidate, const Series& series = data()) {
  try {
    expect_suits(candidate, series);
  } catch (const Error& error) {
    return error.what();
  }
  return "suits";
}

std::string complaint_of_name(std::string_view name, Level level = Level::series) {
  try {
    term_of(name, {}, level);
  } catch (const Error& error) {
    return error.what();
  }
  return "known";
}

TEST(term, has_the_settings_of_the_catalogue) {
  const Term term = term_of("lagged_expansion", {"T_air_degC"});
  ASSERT_EQ(term.settings.size(), 2u);
  EXPECT_EQ(term.effect->name, "lagged_expansion");
  EXPECT_FALSE(term.settings[0].held);
  EXPECT_FALSE(term.settings[1].stated);
  EXPECT_EQ(term.settings[1].start, 1800.0);
  EXPECT_EQ(term.settings[1].lower, 10.0);
  EXPECT_EQ(term.settings[1].upper, 200000.0);
}

TEST(term, label) {
  EXPECT_EQ(label_of(term_of("lagged_expansion", {"T_air_degC"})), "lagged_expansion(T_air_degC)");
  EXPECT_EQ(label_of(own("k * T_air_degC", {gain("k")})), "expression(k * T_air_degC)");
}

TEST(term, name_that_is_not_in_the_catalogue) {
  const std::string message = complaint_of_name("expantion");
  EXPECT_TRUE(message.starts_with("expected an effect on a drift series, one of expansion, lagged_expansion, "))
      << message;
  EXPECT_TRUE(message.ends_with(", found \"expantion\"; the nearest is expansion.")) << message;
  EXPECT_EQ(complaint_of_name("expression"),
            "expression: expected an effect of the catalogue, found one that needs a formula.");
  const std::string on_recording = complaint_of_name("expansion", Level::recording);
  EXPECT_TRUE(on_recording.starts_with("expected an effect on a recording, one of ")) << on_recording;
  EXPECT_TRUE(on_recording.ends_with(", found \"expansion\", which is one on a drift series.")) << on_recording;
}

TEST(model, suits) {
  EXPECT_EQ(complaint(model({})), "suits");
  EXPECT_EQ(complaint(model({term_of("expansion", {"T_air_degC"}), term_of("expansion", {"T_oil_degC"}),
                             term_of("speed_heating", {"speed_rpm"}),
                             own("k * lag(T_oil_degC - T_air_degC, 60) + t", {gain("k")})})),
            "suits");
  Model two = model({});
  two.targets = {"z_um", "x_um"};
  EXPECT_EQ(complaint(two), "suits");
}

TEST(model, targets) {
  Model bad = model({});
  bad.targets = {};
  EXPECT_EQ(complaint(bad), "target: expected at least one column to explain, found none.");
  bad.targets = {"z"};
  EXPECT_EQ(complaint(bad),
            "target: expected a column of the data for the target, one of z_um, x_um, T_air_degC, T_oil_degC, "
            "speed_rpm, found \"z\"; the nearest is z_um.");
  EXPECT_EQ(complaint(bad, {}), "target: expected the column \"z\" in the data for the target, found no columns.");
  bad.targets = {"z_um", "z_um"};
  EXPECT_EQ(complaint(bad), "target: expected each column once, found \"z_um\" again.");
}

TEST(model, columns) {
  EXPECT_EQ(complaint(model({term_of("expansion", {"T_oil_degX"})})),
            "expansion(T_oil_degX): expected a column of the data for temperature, one of z_um, x_um, T_air_degC, "
            "T_oil_degC, speed_rpm, found \"T_oil_degX\"; the nearest is T_oil_degC.");
  EXPECT_EQ(complaint(model({term_of("expansion", {"speed_rpm"})})),
            "expansion(speed_rpm): expected a column in degC or K for temperature, found \"speed_rpm\", which is in "
            "rpm.");
  Series no_unit = data();
  no_unit.columns.push_back({"T_F", Role::event, {1.0, 2.0, 3.0}});
  EXPECT_EQ(complaint(model({term_of("expansion", {"T_F"})}), no_unit),
            "expansion(T_F): expected a column in degC or K for temperature, found \"T_F\", which has no such unit.");
  EXPECT_EQ(complaint(model({term_of("expansion", {})})), "expansion: expected 1 column, for temperature, found 0.");
  EXPECT_EQ(complaint(model({term_of("expansion", {"T_air_degC", "T_oil_degC"})})),
            "expansion(T_air_degC, T_oil_degC): expected 1 column, for temperature, found 2.");
  Model own_input = model({term_of("expansion", {"T_air_degC"})});
  own_input.targets = {"z_um", "T_air_degC"};
  EXPECT_EQ(complaint(own_input),
            "expansion(T_air_degC): expected a column other than the target for temperature, found \"T_air_degC\", "
            "which the model is to explain.");
}

TEST(model, the_same_effect_twice) {
  EXPECT_EQ(complaint(model({term_of("expansion", {"T_air_degC"}), term_of("expansion", {"T_oil_degC"}),
                             term_of("expansion", {"T_air_degC"})})),
            "expansion(T_air_degC): expected each effect on the same columns once, found it as effects 1 and 3.");
  EXPECT_EQ(complaint(model({own("t * k", {gain("k")}), own("t * k", {gain("k")})})),
            "expression(t * k): expected each formula once, found it as effects 1 and 2.");
  EXPECT_EQ(complaint(model({own("t * k", {gain("k")}), own("t^2 * k", {gain("k")})})), "suits");
}

// Two knocks are two steps; where both are free from the same start nothing tells them apart.
TEST(model, the_same_effect_of_time_at_another_start) {
  const auto step = [](std::optional<double> onset_s, bool held = false) {
    Term term = term_of("step", {});
    term.settings[1].held = held;
    term.settings[1].stated = onset_s.has_value();
    term.settings[1].start = onset_s.value_or(0.0);
    return term;
  };
  EXPECT_EQ(label_of(step(std::nullopt)), "step");
  EXPECT_EQ(label_of(step(10.5)), "step(onset_s = 10.5)");
  EXPECT_EQ(complaint(model({step(10.0), step(20.0)})), "suits");
  EXPECT_EQ(complaint(model({step(10.0, true), step(20.0, true), step(std::nullopt)})), "suits");
  EXPECT_EQ(complaint(model({step(10.0), step(10.0, true)})),
            "step(onset_s = 10): expected each effect once, or with another start stated for onset_s, found it as "
            "effects 1 and 2.");
  EXPECT_EQ(complaint(model({step(std::nullopt), step(std::nullopt)})),
            "step: expected each effect once, or with another start stated for onset_s, found it as effects 1 and 2.");
  EXPECT_EQ(complaint(model({term_of("linear_drift", {}), term_of("linear_drift", {})})),
            "linear_drift: expected each effect once, found it as effects 1 and 2.");
  Term early = step(std::nullopt), late = step(std::nullopt);
  early.settings[1].upper = 15.0;
  EXPECT_EQ(label_of(early), "step(onset_s from -inf to 15)");
  EXPECT_EQ(complaint(model({early, late})), "suits");
}

TEST(model, settings) {
  const auto with = [](Setting setting) {
    Term term = term_of("expansion", {"T_air_degC"});
    term.settings[0] = setting;
    return complaint(model({term}));
  };
  EXPECT_EQ(with({.start = 1.0, .lower = 0.0, .upper = 2.0}), "suits");
  EXPECT_EQ(with({.start = 1.0, .lower = -kInfinity, .upper = kInfinity}), "suits");
  EXPECT_EQ(with({.start = NAN, .lower = 0.0, .upper = 2.0}),
            "expansion(T_air_degC): expected a finite number for gain_um_per_K, found nan.");
  EXPECT_EQ(with({.start = 1.0, .lower = 2.0, .upper = 0.0}),
            "expansion(T_air_degC): expected lower below upper for gain_um_per_K, found lower 2 and upper 0.");
  EXPECT_EQ(with({.start = 1.0, .lower = 1.0, .upper = 1.0}),
            "expansion(T_air_degC): expected lower below upper for gain_um_per_K, found lower 1 and upper 1.");
  EXPECT_EQ(with({.start = 3.0, .lower = 0.0, .upper = 2.0}),
            "expansion(T_air_degC): expected a start from 0 to 2 for gain_um_per_K, found 3.");
  EXPECT_EQ(with({.held = true, .start = -3.0, .lower = 0.0, .upper = 2.0}),
            "expansion(T_air_degC): expected a value from 0 to 2 for gain_um_per_K, found -3.");
}

TEST(model, nothing_free) {
  Term held = term_of("expansion", {"T_air_degC"});
  held.settings[0].held = true;
  Model bad = model({held});
  EXPECT_EQ(complaint(bad), "suits");  // the constant
  bad.constant_um = 1.0;
  EXPECT_EQ(complaint(bad), "expected at least one free parameter, found none: every parameter is held.");
  bad.constant_um = NAN;
  EXPECT_EQ(complaint(bad), "constant_um: expected a finite number, found nan.");
}

TEST(model, effects_on_the_other_kind_of_data) {
  Model bad = model({term_of("expansion", {"T_air_degC"})});
  bad.level = Level::recording;
  EXPECT_EQ(complaint(bad), "expansion(T_air_degC): expected effects on a recording, found one on a drift series.");
}

TEST(model, expressions_say_where_in_their_formula) {
  EXPECT_EQ(complaint(model({own("k * lag(T_oli_degC, 60)", {gain("k")})})),
            "expression(k * lag(T_oli_degC, 60)): formula, column 9: expected a column of the data, a parameter of the "
            "effect or t, found \"T_oli_degC\"; the nearest known name is T_oil_degC.");
  EXPECT_EQ(complaint(model({own("k1 * T_oil_degC + kl", {gain("k1")})})),
            "expression(k1 * T_oil_degC + kl): formula, column 19: expected a column of the data, a parameter of the "
            "effect or t, found \"kl\"; the nearest known name is k1.");
  EXPECT_EQ(complaint(model({own("2 * z_um")})),
            "expression(2 * z_um): expected a column other than the target for z_um, found \"z_um\", which the model "
            "is to explain.");
  EXPECT_EQ(complaint(model({own("2 * x_um", {gain("x_um")})})),
            "expression(2 * x_um): formula, column 5: expected a parameter whose name is not that of a column, found "
            "\"x_um\", which the data has too.");
  EXPECT_EQ(complaint(model({own("T_oil_degC / (x_um - 2)")})),
            "expression(T_oil_degC / (x_um - 2)): expected finite values where the parameters start, found inf at 10 "
            "s.");
  EXPECT_EQ(complaint(model({own("lag(sqrt(x_um - 2), 5)")})),
            "expression(lag(sqrt(x_um - 2), 5)): expected finite values where the parameters start, found nan at 0 "
            "s.");
  Series gap = data();
  gap.columns[1].values[1] = NAN;  // x_um
  EXPECT_EQ(complaint(model({own("T_oil_degC / (x_um - 2)")}), gap), "suits");
}

}  // namespace
}  // namespace ballbar
