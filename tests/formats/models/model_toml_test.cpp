#include "ballbar/formats/models/model_toml.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::string_view kGood = R"toml(# what the spindle does
format = "ballbar-model 1"
target = "z_um"
[[effect]]
name = "expansion"
temperature = "T_xi_degC"
gain_um_per_K = 2.244
[[effect]]
name = "lagged_expansion"
temperature = "T_air_degC"
gain_um_per_K = { start = 0.5 }
time_constant_s = { lower = 60, upper = 7200 }
[[effect]]
name = "expression"
formula = "k * lag(T_oil_degC - T_air_degC, tau)"
k = { start = 0.0, unit = "um/K" }
tau = { start = 600.0, lower = 10.0, upper = 20000.0, unit = "s" }
[[history]]
revision = 1
added = ["expansion"]
)toml";

std::string changed(std::string_view from, std::string_view to) {
  if (from == "*") return std::string(to);
  std::string text(kGood);
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good text lacks what a row changes");
  return text.replace(at, from.size(), to);
}

TEST(model_toml, read) {
  const Model model = read_model(kGood, "file");
  EXPECT_EQ(model.level, Level::series);
  EXPECT_EQ(model.targets, std::vector<std::string>{"z_um"});
  EXPECT_FALSE(model.constant_um);
  ASSERT_EQ(model.terms.size(), 3u);
  EXPECT_EQ(label_of(model.terms[0]), "expansion(T_xi_degC)");
  const Setting& held = model.terms[0].settings[0];
  EXPECT_TRUE(held.held);
  EXPECT_EQ(held.start, 2.244);
  const Setting& gain = model.terms[1].settings[0];
  EXPECT_FALSE(gain.held);
  EXPECT_TRUE(gain.stated);
  EXPECT_EQ(gain.start, 0.5);
  EXPECT_EQ(gain.lower, -1000.0);  // the catalogue's
  const Setting& tau = model.terms[1].settings[1];
  EXPECT_FALSE(tau.held);
  EXPECT_FALSE(tau.stated);
  EXPECT_EQ(tau.start, 1800.0);
  EXPECT_EQ(tau.lower, 60.0);
  EXPECT_EQ(tau.upper, 7200.0);
  const Term& own = model.terms[2];
  EXPECT_EQ(label_of(own), "expression(k * lag(T_oil_degC - T_air_degC, tau))");
  EXPECT_EQ(own.columns, (std::vector<std::string>{"T_oil_degC", "T_air_degC"}));
  ASSERT_EQ(own.settings.size(), 2u);
  EXPECT_EQ(own.effect->parameters[0].unit, "um/K");
  EXPECT_EQ(own.effect->parameters[0].kind, ParameterKind::gain);
  EXPECT_EQ(own.effect->parameters[1].kind, ParameterKind::shape);
  EXPECT_EQ(own.settings[0].lower, -kInfinity);
  EXPECT_EQ(own.settings[1].upper, 20000.0);
  EXPECT_TRUE(own.settings[1].stated);
}

// An effect that is in no other catalogue: its terms are that value.
TEST(model_toml, read_with_a_catalogue) {
  Effect effect = *find_effect("expansion", Level::series);
  effect.name = "own_growth";
  const Catalogue own{std::make_shared<const Effect>(effect)};
  constexpr std::string_view kText =
      "format = \"ballbar-model 1\"\ntarget = \"z_um\"\n[[effect]]\nname = \"own_growth\"\n"
      "temperature = \"T_xi_degC\"\n";
  const Model model = read_model(kText, "file", own);
  EXPECT_EQ(model.terms.at(0).effect, own[0]);
  EXPECT_EQ(read_model(write_model(model), "again", own).terms.at(0).effect, own[0]);
  EXPECT_EQ(read_model(with_effect(kText, "file", model.terms[0], own), "more", own).terms.size(), 2U);
  EXPECT_THROW(read_model(kText, "file"), Error);
}

TEST(model_toml, several_targets_a_held_constant_and_no_effect_yet) {
  const Model model =
      read_model("format = \"ballbar-model 1\"\ntarget = [\"x_um\", \"z_um\"]\nconstant_um = 1", "file");
  EXPECT_EQ(model.targets, (std::vector<std::string>{"x_um", "z_um"}));
  EXPECT_EQ(model.constant_um, 1.0);
  EXPECT_TRUE(model.terms.empty());
}

constexpr std::string_view kTrained = R"toml(format = "ballbar-model 1"
target = "z_um"

[trained]   # all of May
T_b_degC = [21, 30.5]
"T a.b \"c\" \u6e29_degC" = [-0.5, -0.5]
T_a_degC = [20, 1e2]

[[effect]]
name = "expansion"
temperature = "T_a_degC"
)toml";

void expect_trained(std::string_view text) {
  const Model model = read_model(text, "file");
  ASSERT_EQ(model.trained.size(), 3u);
  EXPECT_EQ(model.trained[0].column, "T_b_degC");
  EXPECT_EQ(model.trained[0].low, 21.0);
  EXPECT_EQ(model.trained[0].high, 30.5);
  EXPECT_EQ(model.trained[1].column, "T a.b \"c\" \xE6\xB8\xA9_degC");
  EXPECT_EQ(model.trained[1].low, -0.5);
  EXPECT_EQ(model.trained[1].high, -0.5);
  EXPECT_EQ(model.trained[2].column, "T_a_degC");
  EXPECT_EQ(model.trained[2].low, 20.0);
  EXPECT_EQ(model.trained[2].high, 100.0);
}

TEST(model_toml, trained_ranges_in_the_order_of_the_file) { expect_trained(kTrained); }

TEST(model_toml, trained_ranges_are_written_and_read_again) {
  const std::string written = write_model(read_model(kTrained, "file"));
  EXPECT_EQ(written, R"toml(format = "ballbar-model 1"
target = "z_um"

[trained]
T_b_degC = [21.0, 30.5]
"T a.b \"c\" 温_degC" = [-0.5, -0.5]
T_a_degC = [20.0, 100.0]

[[effect]]
name = "expansion"
temperature = "T_a_degC"
)toml");
  expect_trained(written);
}

TEST(model_toml, no_ranges_and_none_stated) {
  EXPECT_TRUE(read_model(kGood, "file").trained.empty());
  EXPECT_TRUE(read_model(changed("[[effect]]", "[trained]\n[[effect]]"), "file").trained.empty());
  EXPECT_EQ(
      read_model("format = \"ballbar-model 1\"\ntarget = \"z_um\"\n[trained]\na = [1, 2]\n", "file").trained.size(),
      1u);
}

TEST(model_toml, trained_ranges_stay_when_effects_change) {
  const std::vector<Term> more{term_of("settling", {})};
  const std::string one_more = with_effect(kTrained, "file", more[0]);
  expect_trained(one_more);
  EXPECT_EQ(read_model(one_more, "file").terms.size(), 2u);
  LedgerRow start, change;
  start.target = change.target = "z_um";
  change.change = "+ settling";
  const std::string revised = with_revision(kTrained, "file", more, {}, start, change);
  expect_trained(revised);
  EXPECT_EQ(without_last_revision(revised, "file"), kTrained);
  const std::size_t first[] = {0};
  change.change = "- expansion(T_a_degC)";
  const std::string fewer = with_revision(kTrained, "file", {}, first, start, change);
  expect_trained(fewer);
  EXPECT_TRUE(read_model(fewer, "file").terms.empty());
  EXPECT_EQ(without_last_revision(fewer, "file"), kTrained);
}

TEST(model_toml, on_recordings) {
  const Model model = read_model(
      "format = \"ballbar-model 1\"\nlevel = \"recording\"\n[[effect]]\nname = \"expression\"\nformula = \"a * cos(4 * "
      "angle_rad)\"\na = { start = 0 }",
      "file");
  EXPECT_EQ(model.level, Level::recording);
  EXPECT_EQ(model.targets, std::vector<std::string>{"deviation_um"});
  EXPECT_EQ(model.terms[0].columns, std::vector<std::string>{"angle_rad"});
  EXPECT_EQ(model.terms[0].effect->level, Level::recording);
}

TEST(model_toml, byte_order_mark_cr_lf_and_no_last_newline) {
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : kGood) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  windows.resize(windows.size() - 2);
  EXPECT_EQ(write_model(read_model(windows, "file")), write_model(read_model(kGood, "file")));
}

TEST(model_toml, written) {
  Model model = read_model(kGood, "file");
  model.targets = {"x_um", "z_um"};
  model.constant_um = 0.5;
  EXPECT_EQ(write_model(model), R"toml(format = "ballbar-model 1"
target = ["x_um", "z_um"]
constant_um = 0.5

[[effect]]
name = "expansion"
temperature = "T_xi_degC"
gain_um_per_K = 2.244

[[effect]]
name = "lagged_expansion"
temperature = "T_air_degC"
gain_um_per_K = { start = 0.5 }
time_constant_s = { lower = 60.0, upper = 7200.0 }

[[effect]]
name = "expression"
formula = "k * lag(T_oil_degC - T_air_degC, tau)"
k = { start = 0.0, unit = "um/K" }
tau = { start = 600.0, lower = 10.0, upper = 20000.0, unit = "s" }
)toml");
}

bool same(const Setting& a, const Setting& b) {
  return a.held == b.held && a.start == b.start && a.lower == b.lower && a.upper == b.upper && a.stated == b.stated;
}

Setting any_setting(Setting setting) {
  const int what = *rc::gen::inRange(0, 4);
  const double start = *rc::gen::inRange(10, 1000) / 7.0 + 9.0;
  if (what == 1) return {true, start, setting.lower, setting.upper, true};
  if (what == 2) return {false, start, setting.lower, setting.upper, true};
  if (what == 3) return {false, start, 1.0 / 3.0, *rc::gen::element(kInfinity, 1e300, 2000.0), true};
  return setting;
}

TEST(model_toml, written_and_read_again_is_the_same) {
  const bool passed = rc::check([] {
    Model model;
    model.targets = {"z_um"};
    if (*rc::gen::arbitrary<bool>()) model.targets.emplace_back("a \"b\"\n_um");
    for (int i = *rc::gen::inRange(0, 4); i > 0; --i) {
      const double low = *rc::gen::inRange(-1000, 1000) / 7.0;
      model.trained.push_back(
          {*rc::gen::element<std::string>("T_a_degC", "T \\ \"\xE6\xB8\xA9_degC", "a.b", "") + std::to_string(i), low,
           low + *rc::gen::inRange(0, 100) / 3.0});
    }
    if (*rc::gen::arbitrary<bool>()) model.constant_um = *rc::gen::inRange(-1000, 1000) / 3.0;
    for (int i = *rc::gen::inRange(0, 5); i > 0; --i) {
      Term term = term_of(*rc::gen::element("expansion", "lagged_expansion"),
                          {*rc::gen::element<std::string>("T_a_degC", "T \\ \xE6\xB8\xA9_degC")});
      if (*rc::gen::arbitrary<bool>()) {
        Parameter k{.name = "k", .unit = *rc::gen::element<std::string>("1", "um/K"), .lower = -kInfinity};
        k.upper = kInfinity;
        k.held = *rc::gen::arbitrary<bool>();
        k.start = *rc::gen::inRange(-100, 100) / 3.0;
        term = expression_term(*rc::gen::element<std::string>("k * T_a_degC", "lag(t,\n k)"), {k});
      } else {
        for (Setting& setting : term.settings) setting = any_setting(setting);
      }
      model.terms.push_back(term);
    }
    const Model again = read_model(write_model(model), "file");
    RC_ASSERT(again.targets == model.targets);
    RC_ASSERT(again.constant_um == model.constant_um);
    RC_ASSERT(again.trained.size() == model.trained.size());
    for (std::size_t i = 0; i < model.trained.size(); ++i) {
      RC_ASSERT(again.trained[i].column == model.trained[i].column);
      RC_ASSERT(again.trained[i].low == model.trained[i].low);
      RC_ASSERT(again.trained[i].high == model.trained[i].high);
    }
    RC_ASSERT(again.terms.size() == model.terms.size());
    for (std::size_t i = 0; i < model.terms.size(); ++i) {
      RC_ASSERT(label_of(again.terms[i]) == label_of(model.terms[i]));
      RC_ASSERT(again.terms[i].columns == model.terms[i].columns);
      for (std::size_t k = 0; k < model.terms[i].settings.size(); ++k) {
        RC_ASSERT(same(again.terms[i].settings[k], model.terms[i].settings[k]));
        RC_ASSERT(again.terms[i].effect->parameters[k].unit == model.terms[i].effect->parameters[k].unit);
      }
    }
  });
  EXPECT_TRUE(passed);
}

TEST(model_toml, an_effect_more_leaves_the_rest_as_it_is) {
  const Term term = term_of("expansion", {"T_oil_degC"});
  const std::string added = "[[effect]]\nname = \"expansion\"\ntemperature = \"T_oil_degC\"\n";
  EXPECT_EQ(with_effect(kGood, "file", term), changed("[[history]]", "\n" + added + "\n[[history]]"));
  EXPECT_EQ(with_effect(changed("[[history]]", "# the ledger\n# of it\n[[history]]"), "file", term),
            changed("[[history]]", "\n" + added + "\n# the ledger\n# of it\n[[history]]"));
  const std::string bare = "\xEF\xBB\xBF# mine\nformat = \"ballbar-model 1\" # one\ntarget = 'z_um'";
  EXPECT_EQ(with_effect(bare, "file", term), bare + "\n\n" + added);
  EXPECT_EQ(read_model(with_effect(kGood, "file", term), "file").terms.size(), 4u);
  const std::string history_first = bare + "\n[[history]]\na = 1\n[[effect]]\nname = 'expression'\nformula = 't'\n";
  EXPECT_EQ(with_effect(history_first, "file", term), history_first + "\n" + added);
  const std::string history_array = bare + "\nhistory = [{ a = 1 }]\n";
  EXPECT_EQ(with_effect(history_array, "file", term), history_array + "\n" + added);
  try {
    with_effect(bare + "\neffect = [{ name = 'expression', formula = 't' }]\n", "file", term);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "file:4:11: expected effects as tables [[effect]], to which one can be added, found an array.");
  }
}

// The first effect's parameters, in the order of the catalogue: gain_um_per_K, time_constant_s.
std::vector<Term> set(std::string_view text, std::size_t parameter, bool held, double value) {
  std::vector<Term> terms = read_model(text, "file").terms;
  Setting& setting = terms[0].settings[parameter];
  setting.held = held;
  setting.start = value;
  setting.stated = true;
  return terms;
}

TEST(model_toml, settings_change_a_file_where_they_stand) {
  const std::string head =
      "\xEF\xBB\xBF"
      "format = \"ballbar-model 1\"\ntarget = \"z_um\"\n\n# the room\n[[effect]]\n"
      "name = \"lagged_expansion\"  # delayed\n";
  const std::string column = "temperature = \"T#1_degC\"\n";
  const std::string tail = "\n# the ledger\n[[history]]\na = 1\n";
  const std::string gain = "gain_um_per_K = { start = 2.0, lower = -5 } # as in May\n";
  const std::string text = head + column + gain + tail;
  EXPECT_EQ(with_settings(text, "file", read_model(text, "file").terms), text);
  EXPECT_EQ(with_settings(text, "file", set(text, 0, true, 3.0)),
            head + column + "gain_um_per_K = 3.0 # as in May\n" + tail);
  EXPECT_EQ(with_settings(text, "file", set(text, 0, false, 3.0)),
            head + column + "gain_um_per_K = { start = 3.0, lower = -5.0, upper = 1000.0 } # as in May\n" + tail);
  // A key that is not there yet stands behind the others.
  EXPECT_EQ(with_settings(text, "file", set(text, 1, true, 600.0)),
            head + column + gain + "time_constant_s = 600.0\n" + tail);
  // Free again from there.
  const std::string held = head + column + "gain_um_per_K = 3.0";
  EXPECT_EQ(with_settings(held, "file", set(held, 0, false, 3.0)), head + column + "gain_um_per_K = { start = 3.0 }");
}

TEST(model_toml, settings_in_tables_of_their_own_are_written_anew) {
  const std::string text =
      "format = \"ballbar-model 1\"\ntarget = \"z_um\"\n[[effect]]\nname = \"expansion\"\n"
      "temperature = \"T_degC\"\n[effect.gain_um_per_K]\nstart = 2.0\n\n[[effect]]\nname = \"expression\"\n"
      "formula = \"k * t\"\nk = { start = 1.0, unit = \"um/s\" }\n";
  const std::string changed = with_settings(text, "file", set(text, 0, true, 3.0));
  EXPECT_TRUE(read_model(changed, "file").terms[0].settings[0].held);
  EXPECT_EQ(read_model(changed, "file").terms[0].settings[0].start, 3.0);
  EXPECT_NE(changed.find("k = { start = 1.0, unit = \"um/s\" }"), std::string::npos);
  std::vector<Term> terms = read_model(text, "file").terms;
  terms[1].settings[0].held = true;
  EXPECT_NE(with_settings(text, "file", terms).find("k = { start = 1.0, unit = \"um/s\", held = true }"),
            std::string::npos);
  terms[0].settings[0].start = 1e9;  // above its bound
  EXPECT_THROW(with_settings(text, "file", terms), Error);
}

struct BadText {
  std::string_view from, to, message;
};

constexpr BadText kBadTexts[] = {
    {"*", "", "file:1:1: expected text, found an empty file."},
    {"*", "target = \"z_um\"\n", "file:1:1: expected the key format, found none."},
    {"*", "# ballbar\nformat = \"ballbar-session 1\"\n",
     "file:2:10: expected \"ballbar-model 1\" for format, found the text \"ballbar-session 1\"."},
    {"model 1", "model 2", "file:2:10: expected \"ballbar-model 1\" for format, found the text \"ballbar-model 2\"."},
    {"target = \"z_um\"\n", "", "file:1:1: expected the key target, found none."},
    {"\"z_um\"", "3", "file:3:10: expected the name of a column or an array of names for target, found the integer 3."},
    {"\"z_um\"", "\"\"", "file:3:10: expected the name of a column for target, found the text \"\"."},
    {"\"z_um\"", "[]", "file:3:10: expected at least one column for target, found none."},
    {"\"z_um\"", "[\"z_um\", 1]", "file:3:19: expected an array of texts for target, found the integer 1."},
    {"\"z_um\"", "[\"z_um\", \"\"]", "file:3:19: expected the name of a column for target, found \"\"."},
    {"\"z_um\"", "[\"z_um\", \"z_um\"]", "file:3:19: expected each target once, found \"z_um\" again."},
    {"target =", "tarjet =",
     "file:3:1: expected one of the keys format, target, level, constant_um, trained, effect, history, found "
     "\"tarjet\"; the nearest is target."},
    {"target =", "level = \"drift\"\ntarget =",
     "file:3:9: expected one of \"series\", \"recording\" for level, found the text \"drift\"."},
    {"target =", "constant_um = \"0\"\ntarget =",
     "file:3:15: expected a finite number for constant_um, found the text \"0\"."},
    {"target =", "constant_um = nan\ntarget =",
     "file:3:15: expected a finite number for constant_um, found the number nan."},
    {"target =", "level = \"recording\"\nconstant_um = 0\ntarget =",
     "file:4:15: expected no constant_um on recordings, whose circle has it, found one."},
    {"[[effect]]", "[effect]",
     "file:8:1: expected TOML, found text that its parser refuses: Error while parsing table header: cannot redefine "
     "existing table 'effect' as array-of-tables."},
    {"*", "format = \"ballbar-model 1\"\ntarget = \"z_um\"\n[effect]\nname = \"expansion\"\n",
     "file:3:1: expected tables [[effect]] for effect, found a table."},
    {"name = \"expansion\"\n", "", "file:4:1: expected the key name in [[effect]] 1, found none."},
    {"\"expansion\"", "1", "file:5:8: expected a text in quotes for name, found the integer 1."},
    {"temperature = \"T_xi_degC\"\n", "",
     "file:4:1: expected a column for each role of expansion, which is temperature, found none for temperature in "
     "[[effect]] 1."},
    {"temperature = \"T_xi_degC\"", "temprature = \"T_xi_degC\"",
     "file:6:1: expected one of the keys name, temperature, gain_um_per_K in [[effect]] 1, found \"temprature\"; the "
     "nearest is temperature."},
    {"temperature = \"T_xi_degC\"", "temperature = 20.0",
     "file:6:15: expected a text in quotes for temperature, found the number 20."},
    {"\"T_xi_degC\"", "\"\"", "file:6:15: expected the name of a column for temperature, found \"\"."},
    {"temperature = \"T_xi_degC\"", "temperature = \"T_xi_degC\"\ntemperature = \"T_air_degC\"",
     "file:7:15: expected TOML, found text that its parser refuses: Error while parsing key-value pair: cannot "
     "redefine existing string 'temperature'."},
    {"gain_um_per_K = 2.244", "gain = 2.244",
     "file:7:1: expected one of the keys name, temperature, gain_um_per_K in [[effect]] 1, found \"gain\"; the nearest "
     "is name."},
    {"2.244", "\"2.244\"",
     "file:7:17: expected a number, which is held, or { start, lower, upper }, which is free from there, for "
     "gain_um_per_K, found the text \"2.244\"."},
    {"2.244", "2,244",
     "file:7:18: expected TOML, found text that its parser refuses: Error while parsing key-value pair: expected a "
     "comment or whitespace, saw ','; decimals need a point."},
    {"2.244", "inf", "file:7:17: expected a finite number for gain_um_per_K, found the number inf."},
    {"2.244", "2244", "file:7:17: expected a value from -1000 to 1000 for gain_um_per_K, found 2244."},
    {"2.244", "{ start = 2, unit = \"um/K\" }",
     "file:7:30: expected one of the keys start, lower, upper in [gain_um_per_K], found \"unit\"; the nearest is "
     "start."},
    {"2.244", "{ start = true }", "file:7:27: expected a finite number for start, found true."},
    {"2.244", "{ lower = nan }", "file:7:27: expected a finite number for lower, found the number nan."},
    {"2.244", "{ lower = inf }", "file:7:27: expected a finite number for lower, found the number inf."},
    {"2.244", "{ start = 1, lower = 2, upper = 0 }",
     "file:7:38: expected lower below upper for gain_um_per_K, found lower 2 and upper 0."},
    {"2.244", "{ upper = -2000 }",
     "file:7:27: expected lower below upper for gain_um_per_K, found lower -1000 and upper -2000."},
    {"2.244", "{ start = 5, lower = 0, upper = 2 }",
     "file:7:27: expected a start from 0 to 2 for gain_um_per_K, found 5."},
    {"2.244", "{ lower = 1 }",
     "file:7:17: expected a start from 1 to 1000 for gain_um_per_K, found 0, which the catalogue has."},
    {"formula = \"k * lag(T_oil_degC - T_air_degC, tau)\"\n", "",
     "file:13:1: expected the key formula in [[effect]] 3, found none."},
    {"\"k * lag(T_oil_degC - T_air_degC, tau)\"", "17",
     "file:15:11: expected a text in quotes for formula, found the integer 17."},
    {"\"k * lag(T_oil_degC - T_air_degC, tau)\"", "\" \"", "file:15:11: formula: expected a formula, found nothing."},
    {"tau)\"", "tau\"", "file:15:11: formula, column 37: expected \")\" for the \"(\" at column 8, found the end."},
    {", tau)", ")", "file:15:11: formula, column 32: expected 2 arguments of lag, found 1."},
    {"k * lag", "k + * lag", "file:15:11: formula, column 5: expected a value, found \"*\"."},
    {"k * lag", "k = lag",
     "file:15:11: formula, column 3: expected \"==\" to compare, found \"=\"; a formula assigns nothing."},
    {"k * lag", "k * lagg",
     "file:15:11: formula, column 5: expected one of the functions lag, sin, cos, tan, asin, acos, atan, sinh, cosh, "
     "tanh, asinh, acosh, atanh, atan2, exp, ln, log, log2, log10, sqrt, abs, sign, rint, min, max, sum, avg, found "
     "\"lagg\"; the nearest known name is lag."},
    {"k = {", "kk = {",
     "file:16:6: expected the parameter \"kk\" in the formula, found k, T_oil_degC, T_air_degC, tau in it; the nearest "
     "is k."},
    {"k = {", "p = 1\nk = {",
     "file:16:5: expected the parameter \"p\" in the formula, found k, T_oil_degC, T_air_degC, tau in it; the nearest "
     "is "
     "k."},
    {"k = {", "temperature = \"T_oil_degC\"\nk = {",
     "file:16:1: expected one of the keys name, formula, k, T_oil_degC, T_air_degC, tau in [[effect]] 3, found "
     "\"temperature\"; the nearest is tau."},
    {"\"k * lag(T_oil_degC - T_air_degC, tau)\"", "\"t\"",
     "file:16:5: expected the parameter \"k\" in the formula, found no names in it."},
    {"k = { start = 0.0, unit = \"um/K\" }", "k = [0.0]",
     "file:16:5: expected a number, which is held, or { start, lower, upper }, which is free from there, for k, found "
     "an array."},
    {"start = 0.0, unit", "unit", "file:16:5: expected start in the table of the parameter k, found none."},
    {"unit = \"um/K\"", "unit = 1", "file:16:27: expected a text in quotes for unit, found the integer 1."},
    {"unit = \"um/K\"", "units = \"um/K\"",
     "file:16:20: expected one of the keys start, lower, upper, unit, held in [k], found \"units\"; the nearest is "
     "unit."},
    {"lower = 10.0", "lower = 1000.0", "file:17:17: expected a start from 1000 to 20000 for tau, found 600."},
    {"[[effect]]", "trained = 1\n[[effect]]",
     "file:4:11: expected a table [trained] for trained, found the integer 1."},
    {"[[effect]]", "[trained]\nT_a_degC = 20.0\n[[effect]]",
     "file:5:12: expected an array of numbers for T_a_degC, found the number 20."},
    {"[[effect]]", "[trained]\nT_a_degC = [20.0]\n[[effect]]",
     "file:5:12: expected the lowest and the highest value of T_a_degC, found 1 numbers."},
    {"[[effect]]", "[trained]\nT_a_degC = [1, 2, 3]\n[[effect]]",
     "file:5:12: expected the lowest and the highest value of T_a_degC, found 3 numbers."},
    {"[[effect]]", "[trained]\nT_a_degC = []\n[[effect]]",
     "file:5:12: expected the lowest and the highest value of T_a_degC, found 0 numbers."},
    {"[[effect]]", "[trained]\nT_a_degC = [30.5, 20.5]\n[[effect]]",
     "file:5:12: expected the lowest and the highest value of T_a_degC, found 30.5 and 20.5."},
    {"[[effect]]", "[trained]\nT_a_degC = [20.5, nan]\n[[effect]]",
     "file:5:19: expected an array of finite numbers for T_a_degC, found the number nan."},
    {"[[effect]]", "[trained]\nT_a_degC = [-inf, 0]\n[[effect]]",
     "file:5:13: expected an array of finite numbers for T_a_degC, found the number -inf."},
    {"[[effect]]", "[trained]\nT_a_degC = [20, '30']\n[[effect]]",
     "file:5:17: expected an array of finite numbers for T_a_degC, found the text \"30\"."},
    {"[[history]]", "[trained]\nT_a_degC = [20, 30]\n[[history]]",
     "file:18:1: expected [trained] above the effects, found it below one."},
    {"[[effect]]\nname = \"expression\"", "[trained]\n[[effect]]\nname = \"expression\"",
     "file:13:1: expected [trained] above the effects, found it below one."},
    {"[[effect]]", "trained.T = { a = [1, 2] }\n[[effect]]",
     "file:4:13: expected an array of numbers for T, found a table."},
    {"[[history]]", "[history]", "file:18:1: expected tables [[history]] for history, found a table."},
    {"*", "format = \"ballbar-model 1\"\ntarget = \"z_um\"\nhistory = \"none\"\n",
     "file:3:11: expected tables [[history]] for history, found the text \"none\"."},
    {"*", "format = \"ballbar-model 1\"\ntarget = \"z_um\"\nhistory = [1]\n",
     "file:3:12: expected tables [[history]] for history, found the integer 1."},
};

TEST(model_toml, bad_text_is_refused_with_a_whole_sentence) {
  for (const BadText& bad : kBadTexts) {
    const std::string text = changed(bad.from, bad.to);
    try {
      read_model(text, "file");
      ADD_FAILURE() << "read without complaint: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string_view(error.what()), bad.message) << text;
    }
  }
}

// The sentence lists the whole catalogue, which grows.
TEST(model_toml, unknown_effect) {
  try {
    read_model(changed("\"expansion\"", "\"expantion\""), "file");
    FAIL();
  } catch (const Error& error) {
    const std::string_view message = error.what();
    EXPECT_TRUE(message.starts_with("file:5:8: expected an effect on a drift series, one of expansion, ")) << message;
    EXPECT_TRUE(message.ends_with(", found \"expantion\"; the nearest is expansion.")) << message;
  }
}

TEST(model_toml, many_effects) {
  std::string text = "format = \"ballbar-model 1\"\ntarget = \"z_um\"\n";
  for (int i = 0; i < 101; ++i) text += "[[effect]]\nname = \"expression\"\nformula = \"" + std::to_string(i) + "\"\n";
  try {
    read_model(text, "file");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "file:303:1: expected at most 100 effects, found 101.");
  }
}

TEST(model_toml, cut_short_is_read_or_refused) {
  for (std::size_t size = 0; size < kGood.size(); ++size) {
    try {
      read_model(kGood.substr(0, size), "file");
    } catch (const Error& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with("file:")) << error.what();
    }
  }
}

}  // namespace
}  // namespace ballbar
