#include "ballbar/internal/fit/held_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

Model lagged() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_degC"}), term_of("lagged_expansion", {"T_degC"})};
  return model;
}

std::vector<FittedParameter> values(const std::vector<double>& numbers) {
  std::vector<FittedParameter> parameters(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) parameters[i].value = numbers[i];
  return parameters;
}

TEST(held_model, is_held_at_every_value_of_the_fit) {
  EXPECT_TRUE(has_free(lagged()));
  const Model held = held_at(lagged(), values({-1.0, 2.0, 3.0, 600.0}));
  EXPECT_FALSE(has_free(held));
  EXPECT_EQ(held.constant_um, -1.0);
  EXPECT_EQ(held.terms[1].settings[1].start, 600.0);
  EXPECT_TRUE(held.terms[1].settings[1].stated);
  const std::vector<FittedParameter> again = held_parameters(held);
  ASSERT_EQ(again.size(), 4u);
  EXPECT_EQ(again[0].value, -1.0);
  EXPECT_EQ(again[1].value, 2.0);
  EXPECT_EQ(again[2].value, 3.0);
  EXPECT_EQ(again[3].value, 600.0);
}

TEST(held_model, one_parameter_or_the_constant_of_a_series_is_enough_to_be_free) {
  Model model = held_at(lagged(), values({0.0, 2.0, 3.0, 600.0}));
  model.terms[1].settings[0].held = false;
  EXPECT_TRUE(has_free(model));
  model.terms[1].settings[0].held = true;
  model.constant_um.reset();
  EXPECT_TRUE(has_free(model));
  model.level = Level::recording;  // whose circle has the constant
  EXPECT_FALSE(has_free(model));
}

TEST(held_model, ranges_of_the_columns_that_it_reads) {
  Series data{{0, 1, 2}, {{"T_degC", Role::structure, {21, std::nan(""), 19}}, {"z_um", Role::measured, {0, 1, 2}}}};
  const std::vector<ColumnRange> ranges = ranges_of(lagged(), data);
  ASSERT_EQ(ranges.size(), 1u) << "a column that two terms read, once";
  EXPECT_EQ(ranges[0].column, "T_degC");
  EXPECT_EQ(ranges[0].low, 19.0);
  EXPECT_EQ(ranges[0].high, 21.0);
  data.columns[0].values.assign(3, std::nan(""));
  EXPECT_TRUE(ranges_of(lagged(), data).empty());
  data.columns[0].name = "T1_degC";
  try {
    ranges_of(lagged(), data);
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "expected the column T_degC in the data to fit it to, found none; the nearest is T1_degC.");
  }
}

}  // namespace
}  // namespace ballbar
