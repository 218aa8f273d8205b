#include "model/bindings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballbar {
namespace {

Series thermometers(int count) {
  Series data;
  data.time_s = {0.0, 60.0};
  for (int k = 0; k < count; ++k) {
    data.columns.push_back({fmt::format("T{}_degC", k), Role::structure, {20.0 + k, 20.0 + k}});
  }
  return data;
}

TEST(bindings, the_warmer_column_is_the_hot_one) {
  using Binding = std::vector<std::string>;
  const Effect& bending = *find_effect("gradient_bending", Level::series);
  EXPECT_EQ(bindings_of(bending, {}, thermometers(3)),
            (std::vector<Binding>{{"T1_degC", "T0_degC"}, {"T2_degC", "T0_degC"}, {"T2_degC", "T1_degC"}}));
}

TEST(bindings, no_target_is_read_nor_one_that_was_put_aside) {
  const Effect& crosstalk = *find_effect("axial_crosstalk", Level::series);
  Series data = thermometers(1);
  data.columns.push_back({"x_um", Role::measured, {0.0, 1.0}});
  data.columns.push_back({"z_um", Role::measured, {0.0, 1.0}});
  Model model;
  model.targets = {"x_um"};
  EXPECT_EQ(bindings_of(crosstalk, model, data).size(), 1U);
  model.targets = {"x_um", "z_um"};
  EXPECT_EQ(count_of_bindings(crosstalk, model, data), 0U);
  model.targets = {"x_um"};
  model.not_inputs = {"z_um"};
  EXPECT_EQ(count_of_bindings(crosstalk, model, data), 0U);
}

// 33 thermometers make 33 * 32 / 2 pairs.
TEST(bindings, are_counted_beyond_those_that_are_searched) {
  const Effect& bending = *find_effect("gradient_bending", Level::series);
  const Series data = thermometers(33);
  EXPECT_EQ(count_of_bindings(bending, {}, data), 528U);
  EXPECT_EQ(bindings_of(bending, {}, data).size(), kMostBindings);
}

}  // namespace
}  // namespace ballbar
