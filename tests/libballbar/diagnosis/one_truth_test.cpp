// The same effect on the same data has the same numbers, whoever asks.
#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnosis/made_drift.hpp"
#include "diagnosis/outcome.hpp"
#include "revision/effect_test_of.hpp"

namespace ballbar {
namespace {

void expect_same(const Candidate& a, const Candidate& b) {
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.bound.columns, b.bound.columns);
  const auto near = [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y)) || std::abs(x - y) <= 1e-9 * std::abs(x);
  };
  EXPECT_PRED2(near, a.p, b.p);
  EXPECT_PRED2(near, a.likelihood_ratio, b.likelihood_ratio);
  EXPECT_PRED2(near, a.amplitude_um, b.amplitude_um);
  EXPECT_PRED2(near, a.amplitude_sigma_um, b.amplitude_sigma_um);
  EXPECT_PRED2(near, a.held_out_before_um, b.held_out_before_um);
  EXPECT_PRED2(near, a.held_out_after_um, b.held_out_after_um);
  EXPECT_PRED2(near, a.held_out_evidence, b.held_out_evidence);
  EXPECT_PRED2(near, a.p_same_gain, b.p_same_gain);
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  for (std::size_t k = 0; k < a.parameters.size(); ++k) {
    EXPECT_PRED2(near, a.parameters[k].value, b.parameters[k].value);
    EXPECT_PRED2(near, a.parameters[k].sigma, b.parameters[k].sigma);
    EXPECT_PRED2(near, a.intervals[k].low, b.intervals[k].low);
    EXPECT_PRED2(near, a.intervals[k].high, b.intervals[k].high);
  }
}

TEST(OneTruth, an_effect_that_is_named_has_the_numbers_of_its_test) {
  for (const double room_um_per_K : {0.5, 1.0, 3.0}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Series data = made::drift({room_um_per_K, seed, 300});
      const Diagnosis found = diagnose(made::by_speed(), data);
      if (found.named.size() != 1 || !found.equivalent.empty() || !found.own.empty()) continue;
      const Term term = term_of(found.named[0].effect->name, found.named[0].columns);
      const EffectTest tested = effect_test(made::by_speed(), {term}, data);
      ASSERT_EQ(tested.added.size(), 1U);
      expect_same(found.candidates.front(), tested.added.front());
      EXPECT_EQ(tested.after.likelihood_ratio, tested.added.front().likelihood_ratio);
      EXPECT_TRUE(tested.added.front().doubts.empty());
      EXPECT_EQ(tested.after.verdict, "supported");
    }
  }
}

// Left out of a model that has it: the same ratio, but for what else may be missing.
TEST(OneTruth, an_effect_left_out_has_the_ratio_of_one_put_in) {
  const Series data = made::drift({3.0, 1, 300});
  Model model = made::by_speed();
  const Term term = term_of("lagged_expansion", {"T_room_degC"});
  const EffectTest tested = effect_test(model, {term}, data);
  model.terms.push_back(term);
  const std::vector<DropTest> dropped = drop_tests(model, 2, data);
  ASSERT_FALSE(dropped.empty());
  EXPECT_EQ(dropped.back().term, 1U);
  EXPECT_TRUE(dropped.back().needed);
  EXPECT_NEAR(dropped.back().likelihood_ratio, tested.added[0].likelihood_ratio,
              0.2 * tested.added[0].likelihood_ratio);
}

Series two_hidden() {
  Series data = made::drift({3.0, 1, 300});
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    const double krpm = data.columns[0].values[i] / 1000.0;
    data.columns.back().values[i] += 0.05 * krpm * krpm;
  }
  return data;
}

// Beside a time constant that the model holds at 70 % of its value.
TEST(OneTruth, an_effect_beside_a_wrong_held_value_has_the_numbers_of_its_test) {
  made::Drift how{3.0, 1};
  how.noise_um = 0.1;
  const Series data = made::drift(how);
  Model model = made::by_speed();
  model.terms.front().settings[1].start = 0.7 * 2300.0;
  model.terms.front().settings[1].held = true;
  const Diagnosis found = diagnose(model, data);
  ASSERT_EQ(found.named.size(), 1U) << made::outcome_of(found);
  ASSERT_FALSE(found.own.empty()) << made::outcome_of(found);
  const EffectTest tested = effect_test(model, {term_of(found.named[0].effect->name, found.named[0].columns)}, data);
  expect_same(found.candidates.front(), tested.added.front());
  EXPECT_EQ(tested.freed, (FreedParameter{"speed_heating(speed_rpm)", "time_constant_s"}));
  EXPECT_EQ(tested.after.verdict, "supported");
}

// Each of two beside the other.
TEST(OneTruth, two_effects_have_the_numbers_of_their_test) {
  const Series data = two_hidden();
  const Diagnosis found = diagnose(made::by_speed(), data);
  ASSERT_EQ(made::labels_of(found.named),
            (std::vector<std::string>{"centrifugal_shift(speed_rpm)", "lagged_expansion(T_room_degC)"}))
      << made::outcome_of(found);
  std::vector<Term> terms;
  for (const BoundEffect& bound : found.named) terms.push_back(term_of(bound.effect->name, bound.columns));
  const EffectTest tested = effect_test(made::by_speed(), terms, data);
  for (std::size_t k = 0; k < 2; ++k) expect_same(found.candidates[k], tested.added[k]);
}

// A shape that the user holds stays there: in what is said of it as in the fit. 30 %: the lag is 1500 s, and what the
// wrong one leaves is a noise with a long memory, of which the two know each its own.
TEST(OneTruth, what_is_held_stays_held) {
  Term term = term_of("lagged_expansion", {"T_room_degC"});
  term.settings[1] = {true, 600.0, term.settings[1].lower, term.settings[1].upper, true};
  const EffectTest tested = effect_test(made::by_speed(), {term}, made::drift({3.0, 1, 300}));
  const Candidate& found = tested.added.front();
  EXPECT_EQ(found.parameters[1].value, 600.0);
  EXPECT_EQ(found.parameters[1].state, ParameterState::held);
  EXPECT_NEAR(found.parameters[0].value, tested.fit_after.parameters[4].value, 0.3 * found.parameters[0].value);
}

// Nor is a gain that is held free.
TEST(OneTruth, a_gain_that_is_held_stays_held) {
  Term term = term_of("lagged_expansion", {"T_room_degC"});
  term.settings[0] = {true, 1.0, term.settings[0].lower, term.settings[0].upper, true};
  const EffectTest tested = effect_test(made::by_speed(), {term}, made::drift({3.0, 1, 300}));
  EXPECT_EQ(tested.added.front().parameters[0].value, 1.0);
}

}  // namespace
}  // namespace ballbar
