#include "ballbar/internal/fit/model_part.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

FittedParameter in_state(ParameterState state) {
  FittedParameter parameter;
  parameter.state = state;
  return parameter;
}

// Free: a constant and a ramp of 1000 um per unit. Held: what would draw anything.
Fit line() {
  Fit fit;
  fit.parameters = {in_state(ParameterState::free), in_state(ParameterState::free), in_state(ParameterState::held)};
  fit.jacobian.resize(4, 3);
  fit.jacobian << 1, 0, 0,  //
      1, 1000, 0,           //
      1, 2000, 0,           //
      1, 3000, 4;
  return fit;
}

// The line of least squares through 0, 0, 0, 4: mean 1, slope sum (t - 1.5) y / sum (t - 1.5)^2 = 6 / 5, so -0.8, 0.4,
// 1.6, 2.8. A line is its own; what has no mean and no slope is none.
TEST(model_part, is_the_projection_on_the_free_columns) {
  const auto parts = model_parts_um(line(), {{0, 0, 0, 4}, {1, 3, 5, 7}, {1, -1, -1, 1}});
  ASSERT_EQ(parts.size(), 3u);
  const double expected[3][4] = {{-0.8, 0.4, 1.6, 2.8}, {1, 3, 5, 7}, {0, 0, 0, 0}};
  for (std::size_t curve = 0; curve < 3; ++curve) {
    for (std::size_t row = 0; row < 4; ++row) EXPECT_NEAR(parts[curve][row], expected[curve][row], 1e-12);
  }
}

// The third column is the second: no freedom to draw the last reading.
TEST(model_part, columns_that_are_the_same_are_one) {
  Fit fit = line();
  fit.parameters[2].state = ParameterState::free;
  fit.jacobian.col(2) = fit.jacobian.col(1);
  EXPECT_NEAR(model_parts_um(fit, {{0, 0, 0, 4}})[0][3], 2.8, 1e-12);
}

TEST(model_part, of_a_model_with_nothing_free_is_zero) {
  Fit fit = line();
  for (FittedParameter& parameter : fit.parameters) parameter.state = ParameterState::held;
  EXPECT_EQ(model_parts_um(fit, {{1, 2, 3, 4}})[0], std::vector<double>(4, 0.0));
  EXPECT_TRUE(model_parts_um(line(), {{}})[0].empty()) << "a curve that could not be drawn";
}

}  // namespace
}  // namespace ballbar
