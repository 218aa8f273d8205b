// Effects as the command line names them.
#include "ballbar/internal/model/effect_argument.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

Series data() {
  Series series;
  series.time_s = {0.0, 60.0, 120.0};
  for (const char* name : {"T1_degC", "T2_degC"}) series.columns.push_back({name, Role::structure, {20.0, 21.0, 22.5}});
  series.columns.push_back({"speed_rpm", Role::speed, {0.0, 1000.0, 1000.0}});
  series.columns.push_back({"z_um", Role::measured, {0.0, 1.0, 2.0}});
  return series;
}

Model model() {
  Model result;
  result.targets = {"z_um"};
  result.terms.push_back(term_of("expansion", {"T1_degC"}));
  return result;
}

using Columns = std::vector<std::string>;

TEST(TermText, columns_named) {
  EXPECT_EQ(term_from_text("lagged_expansion:temperature=T2_degC", model(), data()).columns, Columns{"T2_degC"});
  const Term both = term_from_text("gradient_bending:cold=T1_degC,hot=T2_degC", model(), data());
  EXPECT_EQ(both.columns, (Columns{"T2_degC", "T1_degC"}));
}

TEST(TermText, columns_found_where_there_is_one_choice) {
  EXPECT_EQ(term_from_text("speed_heating", model(), data()).columns, Columns{"speed_rpm"});
  EXPECT_EQ(term_from_text("linear_drift", model(), data()).columns, Columns{});
  EXPECT_EQ(term_from_text("expansion", model(), data()).columns, Columns{"T2_degC"});  // T1_degC is in the model
  EXPECT_EQ(term_from_text("viscosity_feedback:temperature=T2_degC", model(), data()).columns,
            (Columns{"speed_rpm", "T2_degC"}));
}

// As labels are printed; a column is missing where only one is left for it.
TEST(TermText, columns_in_brackets) {
  EXPECT_EQ(term_from_text("lagged_expansion(T2_degC)", model(), data()).columns, Columns{"T2_degC"});
  EXPECT_EQ(term_from_text("gradient_bending(T2_degC, T1_degC)", model(), data()).columns,
            (Columns{"T2_degC", "T1_degC"}));
  EXPECT_EQ(term_from_text("gradient_bending(T2_degC)", model(), data()).columns, (Columns{"T2_degC", "T1_degC"}));
  EXPECT_EQ(term_from_text("gradient_bending(cold=T1_degC)", model(), data()).columns, (Columns{"T2_degC", "T1_degC"}));
  EXPECT_EQ(term_from_text("gradient_bending(cold=T1_degC,T2_degC)", model(), data()).columns,
            (Columns{"T2_degC", "T1_degC"}));
  EXPECT_EQ(term_from_text("viscosity_feedback(T2_degC)", model(), data()).columns, (Columns{"speed_rpm", "T2_degC"}));
  EXPECT_EQ(term_from_text("speed_heating()", model(), data()).columns, Columns{"speed_rpm"});
}

// Whatever a column is called, but for quotes, commas, semicolons, brackets and blanks.
TEST(TermText, columns_of_any_name) {
  for (const char* name : {"K\u00fchlmittel_degC", "\u6cb9_degC", "hot=1_degC", "T:1_degC", "T/oil-2.a+b*c^d_degC",
                           "onset_s", "from_degC", "--T_degC", "$T{1}[2]_degC"}) {
    Series wide = data();
    wide.columns.push_back({name, Role::structure, {20.0, 21.0, 22.5}});
    const Term term = term_of("gradient_bending", {name, "T2_degC"});
    EXPECT_EQ(term_from_text(label_of(term), model(), wide).columns, term.columns) << name;
  }
}

// Every effect of the catalogue as it is printed, bound to columns, is what it was.
TEST(TermText, labels_come_back) {
  Series wide = data();
  for (const auto& effect : built_in_catalogue()) {
    for (const Input& input : effect->inputs) {
      for (const std::string& unit : input.units) {
        for (const char* number : {"1", "2", "3"}) {
          const std::string name = fmt::format("A{}_\u00b5{}", number, unit == "1" ? "" : "_" + unit);
          if (find_column(wide, name) == nullptr) wide.columns.push_back({name, Role::structure, {20.0, 21.0, 22.5}});
        }
      }
    }
  }
  std::size_t bound = 0;
  for (const auto& effect : built_in_catalogue()) {
    Model own = model();
    own.level = effect->level;
    std::vector<Term> terms{term_of(effect->name, {}, effect->level)};
    if (effect->level == Level::series && !effect->inputs.empty()) {
      for (const std::string& unit : effect->inputs.front().units) {
        Columns columns;
        for (std::size_t k = 0; k < effect->inputs.size(); ++k) {
          const std::vector<std::string>& units = effect->inputs[k].units;
          const bool has = std::find(units.begin(), units.end(), unit) != units.end();
          const std::string& suffix = has ? unit : units.front();
          columns.push_back(fmt::format("A{}_\u00b5{}", 3 - k, suffix == "1" ? "" : "_" + suffix));
        }
        terms.push_back(term_of(effect->name, columns));
      }
      terms.erase(terms.begin());
      ++bound;
    }
    for (std::size_t k = 0; k < effect->parameters.size(); ++k) {  // what a label tells of shapes
      Term stated = term_of(effect->name, {}, effect->level);
      const Parameter& parameter = effect->parameters[k];
      if (parameter.shape_of == ShapeOf::recording) {
        stated.settings[k].held = true;
        stated.settings[k].start = 1.0;
      } else if (parameter.kind == ParameterKind::shape &&
                 (effect->inputs.empty() || effect->level == Level::recording)) {
        stated.settings[k].start = parameter.start * 1.03;
        stated.settings[k].stated = true;
        Term ranged = term_of(effect->name, {}, effect->level);
        ranged.settings[k].upper = parameter.start * 1.7 + 1.0 / 3.0;
        terms.push_back(ranged);
      } else {
        continue;
      }
      terms.push_back(stated);
    }
    for (const Term& term : terms) {
      const std::string label = label_of(term);
      const Term same = term_from_text(label, own, wide);
      EXPECT_EQ(same.effect, term.effect) << label;
      EXPECT_EQ(same.columns, term.columns) << label;
      EXPECT_EQ(label_of(same), label);
      for (std::size_t k = 0; k < term.settings.size(); ++k) {
        EXPECT_EQ(same.settings[k].start, term.settings[k].start) << label;
        EXPECT_EQ(same.settings[k].upper, term.settings[k].upper) << label;
        EXPECT_EQ(same.settings[k].held, term.settings[k].held) << label;
      }
    }
  }
  EXPECT_GT(bound, 10U);
}

TEST(TermText, on_recordings) {
  Model recording;
  recording.level = Level::recording;
  EXPECT_EQ(term_from_text("squareness", recording, {}).effect->name, "squareness");
}

struct Bad {
  const char* text;
  const char* message;
};

TEST(TermText, bad_text) {
  const Bad rows[] = {
      {"lagged_expansion",
       "lagged_expansion: expected columns, for which the data offer 2 choices: lagged_expansion(T1_degC), "
       "lagged_expansion(T2_degC)."},
      {"lagged_expansion:", "lagged_expansion: expected role=column, found \"\"."},
      {"lagged_expansion:T1_degC", "lagged_expansion: expected role=column, found \"T1_degC\"."},
      {"lagged_expansion:temperature=", "lagged_expansion: expected role=column, found \"temperature=\"."},
      {"lagged_expansion:temperatur=T1_degC",
       "lagged_expansion: expected a role, one of temperature, found \"temperatur\"; the nearest is temperature."},
      {"gradient_bending:hot=T1_degC,hot=T2_degC", "gradient_bending: expected each role once, found hot again."},
      {"lagged_expansion:temperature=T1_dgC",
       "lagged_expansion: expected a column of the data for temperature, found \"T1_dgC\"; the nearest is T1_degC."},
      {"linear_drift:time=time_s", "linear_drift: expected no columns, which it does not read, found \"time=time_s\"."},
      {"load_heating",
       "load_heating: expected columns of the data for load in W or A or percent or Nm, found none that suit."},
      {"gradient_bending:hot=z_um",
       "gradient_bending: expected columns of the data for hot in degC or K and cold in degC or K beside those named, "
       "found none that suit."},
      {"lagged_expansion(T1_dgC)",
       "lagged_expansion: expected a column of the data for temperature, found \"T1_dgC\"; the nearest is T1_degC."},
      {"lagged_expansion(T1_degC, T2_degC)", "lagged_expansion: expected 1 column, for temperature, found 2."},
      {"gradient_bending(T1_degC, T2_degC, speed_rpm)",
       "gradient_bending: expected 2 columns, for hot and cold, found 3."},
      {"gradient_bending(T1_degC, hot=T2_degC, cold=T2_degC)",
       "gradient_bending: expected 2 columns, for hot and cold, found 3."},
      {"gradient_bending(T1_degC, cld=T2_degC)",
       "gradient_bending: expected a role, one of hot, cold, found \"cld\"; the nearest is cold."},
      {"gradient_bending(T1_degC,)", "gradient_bending: expected a column for cold, found \"\"."},
      {"lagged_expansion(T1_degC",
       "lagged_expansion: expected columns in brackets, lagged_expansion(COLUMN, ...), found \"(T1_degC\"."},
      {"lagged_expansion T1_degC",
       "lagged_expansion: expected columns in brackets, lagged_expansion(COLUMN, ...), found \"T1_degC\"."},
      {"linear_drift(T1_degC)", "linear_drift: expected no columns, which it does not read, found \"T1_degC\"."},
      {"step(onset_s = soon)", "step: expected onset_s = NUMBER, or from NUMBER to NUMBER, found \"onset_s = soon\"."},
      {"step(onset_s from 1)", "step: expected onset_s = NUMBER, or from NUMBER to NUMBER, found \"onset_s from 1\"."},
      {"expression(k * T1_degC)",
       "expression: expected an effect of the catalogue, found a formula, which stands in the model's file with the "
       "starts of its parameters."},
      {"expression", "expression: expected an effect of the catalogue, found one that needs a formula."},
  };
  for (const Bad& row : rows) {
    try {
      term_from_text(row.text, model(), data());
      ADD_FAILURE() << row.text << " was taken";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), row.message);
    }
  }
}

TEST(TermText, every_choice_is_in_the_model) {
  Model full = model();
  full.terms.push_back(term_of("speed_heating", {"speed_rpm"}));
  try {
    term_from_text("speed_heating", full, data());
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "speed_heating: expected a choice of columns that is not in the model yet, found none.");
  }
}

}  // namespace
}  // namespace ballbar
