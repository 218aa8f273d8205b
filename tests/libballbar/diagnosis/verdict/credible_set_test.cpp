// Figures of a posterior that is made up.
#include "diagnosis/verdict/credible_set.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

// Two single effects over the expansion with A, that with B, and a bending of both.
Problem with_three() {
  Problem problem;
  problem.library.families = {{{find_effect("expansion", Level::series), {"A_degC"}}},
                              {{find_effect("expansion", Level::series), {"B_degC"}}},
                              {{find_effect("gradient_bending", Level::series), {"A_degC", "B_degC"}}}};
  problem.effects = 3;
  return problem;
}

Posterior of_two() {
  Posterior posterior;
  posterior.modes = {{1.0, {{{0.5, 0.1, 0.3}}, {{0.0, 0.6, 0.02}}}}};
  return posterior;
}

// A: 1 - (1 - 0.8) (1 - 0.02) = 0.804; B: 1 - (1 - 0.4) (1 - 0.62) = 0.772.
TEST(Probabilities, of_columns) {
  const std::vector<Driver> drivers = drivers_of(with_three(), of_two());
  ASSERT_EQ(drivers.size(), 2U);
  EXPECT_EQ(drivers[0].column, "A_degC");
  EXPECT_NEAR(drivers[0].p, 0.804, 1e-12);
  EXPECT_EQ(drivers[1].column, "B_degC");
  EXPECT_NEAR(drivers[1].p, 0.772, 1e-12);
}

// Of two modes that exclude each other: the bending is in the first, the expansion with B in the second.
TEST(Probabilities, of_columns_in_two_modes) {
  Posterior posterior;
  posterior.modes = {{0.7, {{{0.0, 0.0, 1.0}}}}, {0.3, {{{0.0, 1.0, 0.0}}}}};
  const std::vector<Driver> drivers = drivers_of(with_three(), posterior);
  ASSERT_EQ(drivers.size(), 2U);
  EXPECT_EQ(drivers[0].column, "B_degC");
  EXPECT_NEAR(drivers[0].p, 1.0, 1e-12);
  EXPECT_NEAR(drivers[1].p, 0.7, 1e-12);
}

// 0.95 of 0.9 is 0.855: 0.5 + 0.3 falls short of it. 0.95 of 0.62 is 0.589.
TEST(Probabilities, credible_sets) {
  EXPECT_EQ(credible_set(of_two().modes[0].effects[0]), (std::vector<std::size_t>{0, 2, 1}));
  EXPECT_EQ(credible_set(of_two().modes[0].effects[1]), (std::vector<std::size_t>{1}));
}

}  // namespace
}  // namespace ballbar
