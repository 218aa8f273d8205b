// Figures of a posterior, of sets whose weights are made up.
#include "diagnosis/verdict/probabilities.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballbar {
namespace {

// Nothing 0.2, of which half with a discrepancy, and an effect 0.8.
Posterior one_of_two() {
  EffectSet nothing, effect;
  nothing.log_weight = std::log(0.2);
  nothing.log_weight_slow = std::log(0.1);
  effect.families = {0};
  effect.log_weight = std::log(0.8);
  effect.log_weight_slow = -1e300;
  Posterior posterior;
  posterior.sets = {effect, nothing};
  return posterior;
}

Problem with_one_effect() {
  Problem problem;
  problem.library.families = {{{find_effect("expansion", Level::series), {"T_a_degC"}}}};
  problem.effects = 1;
  return problem;
}

// Odds of 4 to 1. Before the readings they are 0.5 to 0.5; with a value that the model holds, which may be another one
// with 0.2, they are 0.6 to 0.5 x 0.8 = 0.4. A discrepancy is on both sides.
TEST(Probabilities, log_bayes_factor_of_anything_against_nothing) {
  Problem problem = with_one_effect();
  const Probabilities found = probabilities_of(problem, one_of_two());
  EXPECT_NEAR(found.log_bayes_factor, std::log(4.0), 1e-12);
  EXPECT_NEAR(found.nothing, 0.1, 1e-12);
  problem.own = {{1, 1.0}};
  EXPECT_NEAR(probabilities_of(problem, one_of_two()).log_bayes_factor, std::log(4.0 / 1.5), 1e-12);
  Posterior nothing = one_of_two();
  nothing.sets.erase(nothing.sets.begin());
  EXPECT_EQ(probabilities_of(problem, nothing).log_bayes_factor, 0.0);
}

}  // namespace
}  // namespace ballbar
