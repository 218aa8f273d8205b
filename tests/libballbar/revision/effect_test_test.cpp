// Effects added for a try, and earlier ones tested anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ballbar/error.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "effect_test_of.hpp"

namespace ballbar {
namespace {

// z = 10 T + e, e orthogonal to 1 and to T. With the effect a square of 4 is left; without it the part of T about its
// mean stays too, 6 * 5^2 + 4 = 154. Fewer than 30 values: white noise.
Series six_values() {
  Series data;
  data.time_s = {0.0, 60.0, 120.0, 180.0, 240.0, 300.0};
  data.columns = {{"T_degC", Role::structure, {0.0, 1.0, 0.0, 1.0, 0.0, 1.0}},
                  {"z_um", Role::measured, {1.0, 11.0, -1.0, 9.0, 0.0, 10.0}}};
  return data;
}

constexpr double kAscent = 0.01;  // the ascent ends where the bound rises by no more

// 2 ln B of one gain: of `before`, with nu degrees of freedom, it takes `gain` away. Over the sizes d of the gain it is
// the mean by its prior; of the variance v, the likeliest with the effect and the likeliest without:
//
//   ln p = -1/2 (nu ln v + before / v) + ln mean of exp(gain d^2 / (1 + d^2) / 2 v) / sqrt(1 + d^2)
double log_bayes_factor(double before, double gain, double nu) {
  const auto log_likelihood = [&](double variance, bool with) {
    double sum = 0.0;
    for (const double d : kGainSizes) {
      const double explained = with ? gain * d * d / (1.0 + d * d) : 0.0;
      sum += std::exp(0.5 * explained / variance) / std::sqrt(with ? 1.0 + d * d : 1.0);
    }
    return std::log(sum / static_cast<double>(kGainSizes.size())) - 0.5 * (nu * std::log(variance) + before / variance);
  };
  double without = -1e9, with = -1e9;
  for (double log_variance = std::log(0.5); log_variance < std::log(200.0); log_variance += 1e-4) {
    without = std::max(without, log_likelihood(std::exp(log_variance), false));
    with = std::max(with, log_likelihood(std::exp(log_variance), true));
  }
  return 2.0 * (with - without);
}

Model constant() {
  Model model;
  model.targets = {"z_um"};
  return model;
}

TEST(EffectTest, six_values_by_hand) {
  const EffectTest found = effect_test(constant(), {term_of("expansion", {"T_degC"})}, six_values());
  EXPECT_NEAR(found.before.rmse_um, std::sqrt(154.0 / 6.0), 1e-6);
  EXPECT_NEAR(found.after.rmse_um, std::sqrt(4.0 / 6.0), 1e-6);
  EXPECT_EQ(found.before.parameters, 1u);
  EXPECT_EQ(found.after.parameters, 2u);
  EXPECT_EQ(found.after.change, "+ expansion(T_degC)");
  EXPECT_TRUE(found.earlier.empty());
  ASSERT_EQ(found.added.size(), 1u);
  EXPECT_NEAR(found.added[0].amplitude_um, 10.0, 1e-6);
  EXPECT_NEAR(found.added[0].likelihood_ratio, log_bayes_factor(154.0, 150.0, 5.0), kAscent);  // 10.63
  EXPECT_NEAR(found.after.likelihood_ratio, found.added[0].likelihood_ratio, 1e-12);
  EXPECT_EQ(found.added[0].threshold, kLeastLikelihoodRatio);
}

// A search gives this effect columns of a bar alone; a user may say another.
TEST(EffectTest, columns_that_no_search_tries_are_weighed_all_the_same) {
  Series data = six_values();
  for (double& value : data.columns[0].values) value += 20.0;
  for (double& value : data.columns[1].values) value *= 0.1;  // the gain stays within its bounds
  const EffectTest found = effect_test(constant(), {term_of("bar_temperature", {"T_degC"})}, data);
  ASSERT_EQ(found.added.size(), 1u);
  EXPECT_NEAR(found.added[0].amplitude_um, 1.0, 1e-6);
  EXPECT_NEAR(found.added[0].likelihood_ratio, log_bayes_factor(154.0, 150.0, 5.0), kAscent);
}

// Nothing to explain, and too few values to explain anything: the effect is not supported.
TEST(EffectTest, readings_that_tell_nothing) {
  Series still = six_values();
  for (double& value : still.columns[1].values) value = 2.0;
  Series few = six_values();
  few.time_s.resize(4);
  for (Column& column : few.columns) column.values.resize(4);
  for (const Series& data : {still, few}) {
    const EffectTest found = effect_test(constant(), {term_of("expansion", {"T_degC"})}, data);
    EXPECT_EQ(found.after.verdict, "not supported");
    EXPECT_FALSE(found.after.likelihood_ratio > 0.0);
  }
}

// As likely beforehand to be needed as not: P = 1 / (1 + B).
TEST(EffectTest, needed_by_the_bayes_factor) {
  Model model = constant();
  model.terms.push_back(term_of("expansion", {"T_degC"}));
  const std::vector<DropTest> found = drop_tests(model, 1, six_values());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, "expansion(T_degC)");
  EXPECT_EQ(found[0].parameters, 1u);
  EXPECT_NEAR(found[0].p, 1.0 / (1.0 + std::exp(0.5 * log_bayes_factor(154.0, 150.0, 5.0))), 1e-6);
  EXPECT_TRUE(found[0].needed);
}

TEST(EffectTest, held_effects_are_not_tested) {
  Model model = constant();
  model.terms.push_back(term_of("expansion", {"T_degC"}));
  model.terms[0].settings[0] = {true, 10.0, -1e9, 1e9, true};
  EXPECT_TRUE(drop_tests(model, 1, six_values()).empty());
}

// With the constant held nothing is free without the effect: the residual is then 10 T + e whole, 300 + 4 + 2 * 10 * 0.
TEST(EffectTest, nothing_free_without_the_effect) {
  Model model = constant();
  model.constant_um = 0.0;
  model.terms.push_back(term_of("expansion", {"T_degC"}));
  const std::vector<DropTest> found = drop_tests(model, 1, six_values());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].likelihood_ratio, log_bayes_factor(304.0, 300.0, 6.0), kAscent);
}

// 300 rows of 5 steps of the speed; z follows the room, nothing else.
Series warm_up() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      oil{"T_oil_degC", Role::coolant, {}}, z{"z_um", Role::measured, {}};
  for (int i = 0; i < 300; ++i) {
    data.time_s.push_back(60.0 * i);
    speed.values.push_back(i / 60 % 2 == 0 ? 0.0 : 1000.0 * (1 + i / 120));
    room.values.push_back(20.0 + std::sin(i / 17.0));
    oil.values.push_back(25.0 + std::cos(i / 29.0));
    z.values.push_back(4.0 * room.values.back() + 0.2 * normal(random));
  }
  data.columns = {speed, room, oil, z};
  return data;
}

TEST(EffectTest, of_what_is_there) {
  const EffectTest found = effect_test(constant(), {term_of("expansion", {"T_room_degC"})}, warm_up());
  EXPECT_EQ(found.after.verdict, "supported");
  EXPECT_TRUE(found.added[0].doubts.empty());
  EXPECT_LT(found.after.held_out_um, found.before.held_out_um);
  EXPECT_NEAR(found.after.rmse_um, 0.2, 0.03);  // the noise: 300 values, 4 % of sigma
}

TEST(EffectTest, of_what_is_not) {
  Model model = constant();
  model.terms.push_back(term_of("expansion", {"T_room_degC"}));
  const EffectTest found = effect_test(model, {term_of("expansion", {"T_oil_degC"})}, warm_up());
  EXPECT_EQ(found.after.verdict, "not supported");
  EXPECT_EQ(found.after.still_needed, std::vector<std::string>{"expansion(T_room_degC)"});
}

// Both jumps would have the figures of one.
TEST(EffectTest, an_effect_once) {
  Term first = term_of("step", {}), second = first;
  first.settings[1].start = 3600.0;
  second.settings[1].start = 9000.0;
  first.settings[1].stated = second.settings[1].stated = true;
  EXPECT_THROW(effect_test(constant(), {first, second}, warm_up()), Error);
}

// The user's range is the prior of a shape, also where the grid of the catalogue ends.
TEST(EffectTest, a_stated_range_holds_the_shape) {
  Series data = warm_up();
  double slow = data.columns[1].values.front();
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    slow += (data.columns[1].values[i] - slow) * (1.0 - std::exp(-60.0 / 7200.0));
    data.columns[3].values[i] += 40.0 * slow - 4.0 * data.columns[1].values[i];
  }
  Term lagged = term_of("lagged_expansion", {"T_room_degC"});
  const auto time =
      static_cast<std::size_t>(std::find_if(lagged.effect->parameters.begin(), lagged.effect->parameters.end(),
                                            [](const Parameter& parameter) { return parameter.unit == "s"; }) -
                               lagged.effect->parameters.begin());
  lagged.settings[time].lower = 400.0;
  lagged.settings[time].upper = 900.0;
  lagged.settings[time].start = 600.0;
  const EffectTest found = effect_test(constant(), {lagged}, data);
  EXPECT_LE(found.added[0].parameters[time].value, 900.0);
  EXPECT_GE(found.added[0].parameters[time].value, 400.0);
}

// Beside a jump of 8 um that is not in the model either, 1 um with the room is noise. The diagnosis names both, and
// each of them is supported when it is added first.
TEST(EffectTest, tested_beside_what_is_missing_as_well) {
  Series data = warm_up();
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    double& z_um = data.columns[3].values[i];
    z_um += (i < 170 ? 0.0 : 8.0) - 3.5 * data.columns[1].values[i];
  }
  const Term room = term_of("expansion", {"T_room_degC"}), step = term_of("step", {});
  const EffectTest of_room = effect_test(constant(), {room}, data);
  EXPECT_EQ(of_room.beside, std::vector<std::string>{"step"});
  EXPECT_EQ(of_room.after.verdict, "supported");
  EXPECT_NEAR(of_room.added[0].amplitude_um, 1.0, 0.1);
  const EffectTest of_step = effect_test(constant(), {step}, data);
  // An effect of the room; these readings do not tell whether it lags by 2 min.
  ASSERT_EQ(of_step.beside.size(), 1U);
  EXPECT_TRUE(of_step.beside.front().ends_with("expansion(T_room_degC)")) << of_step.beside.front();
  EXPECT_NEAR(of_step.added[0].amplitude_um, 8.0, 0.2);
  const EffectTest both = effect_test(constant(), {room, step}, data);
  EXPECT_TRUE(both.beside.empty());
  EXPECT_NEAR(both.added[0].likelihood_ratio, of_room.added[0].likelihood_ratio, 1e-6);
}

TEST(EffectTest, pruned_of_what_is_not_needed) {
  Model model = constant();
  model.terms.push_back(term_of("linear_drift", {}));
  model.terms.push_back(term_of("expansion", {"T_oil_degC"}));
  const Series data = warm_up();
  const EffectTest tried = effect_test(model, {term_of("expansion", {"T_room_degC"})}, data);
  EXPECT_EQ(tried.after.no_longer_needed.size(), 2u);
  const Pruned smaller = pruned(tried, data);
  EXPECT_EQ(smaller.removed, (std::vector<std::size_t>{0, 1}));
  ASSERT_EQ(smaller.effect_test.model.terms.size(), 1u);
  EXPECT_EQ(smaller.effect_test.after.parameters, 2u);
  EXPECT_TRUE(smaller.effect_test.after.no_longer_needed.empty());
  EXPECT_TRUE(smaller.effect_test.after.change.starts_with("+ expansion(T_room_degC), - "));
}

}  // namespace
}  // namespace ballbar
