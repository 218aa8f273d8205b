// Effects as the command line names them.
#include "ballbar/model/effect_argument.hpp"

#include <gtest/gtest.h>

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
       "lagged_expansion: expected columns, for which the data offer 2 choices: lagged_expansion:temperature=T1_degC "
       "lagged_expansion:temperature=T2_degC."},
      {"lagged_expansion:", "lagged_expansion: expected role=column, found \"\"."},
      {"lagged_expansion:T1_degC", "lagged_expansion: expected role=column, found \"T1_degC\"."},
      {"lagged_expansion:temperature=", "lagged_expansion: expected role=column, found \"temperature=\"."},
      {"lagged_expansion:temperatur=T1_degC",
       "lagged_expansion: expected a role, one of temperature, found \"temperatur\"; the nearest is temperature."},
      {"gradient_bending:hot=T1_degC,hot=T2_degC", "gradient_bending: expected each role once, found hot again."},
      {"lagged_expansion:temperature=T1_dgC",
       "lagged_expansion: expected a column of the data for temperature, found \"T1_dgC\"; the nearest is T1_degC."},
      {"linear_drift:time=time_s", "linear_drift: expected no columns, which it does not read, found \"time=time_s\"."},
      {"load_heating", "load_heating: expected columns of the data for load in W or A, found none that suit."},
      {"gradient_bending:hot=z_um",
       "gradient_bending: expected columns of the data for hot in degC or K and cold in degC or K beside those named, "
       "found none that suit."},
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
