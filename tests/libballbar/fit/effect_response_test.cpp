#include "ballbar/internal/fit/effect_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ballbar {
namespace {

FittedParameter value(double number) {
  FittedParameter parameter;
  parameter.value = number;
  return parameter;
}

Series warming() {
  return {{0, 60, 120, 180}, {{"T_degC", Role::structure, {20, 21, 24, 30}}, {"z_um", Role::measured, {0, 2, 8, 20}}}};
}

// 2 um/K (T - T0).
TEST(effect_um, is_what_the_effect_adds_alone) {
  const Term term = term_of("expansion", {"T_degC"});
  const FittedParameter gain[] = {value(2.0)};
  EXPECT_EQ(effect_um(term, gain, warming()), (std::vector<double>{0, 2, 8, 20}));
}

// From 20 to 30 degC at once: 2 um/K 10 K = 20 um. No time constant: 30 min, and 3 min before.
TEST(step_response, of_free_expansion_is_a_step) {
  const FittedParameter gain[] = {value(2.0)};
  const auto step = step_response(term_of("expansion", {"T_degC"}), gain, 0, warming());
  ASSERT_TRUE(step);
  EXPECT_EQ(step->input, "T_degC");
  EXPECT_EQ(step->from, 20.0);
  EXPECT_EQ(step->to, 30.0);
  ASSERT_EQ(step->time_s.size(), 240u);
  EXPECT_NEAR(step->time_s.front(), -180.0, 1e-9);
  EXPECT_NEAR(step->time_s.back(), 1800.0, 1e-9);
  for (std::size_t i = 0; i < step->time_s.size(); ++i) {
    EXPECT_DOUBLE_EQ(step->response_um[i], step->time_s[i] < 0.0 ? 0.0 : 20.0) << step->time_s[i] << " s";
  }
}

// 20 um (1 - exp(-t / 600 s)) over five time constants: 63.2 % after one, 99.3 % at the end. The step is a line over
// one row of 13.8 s, which is 0.2 um of the slope of 20 um / 600 s.
TEST(step_response, of_what_lags_takes_five_time_constants) {
  const FittedParameter parameters[] = {value(2.0), value(600.0)};
  const auto step = step_response(term_of("lagged_expansion", {"T_degC"}), parameters, 0, warming());
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->time_s.front(), -300.0, 1e-9);
  EXPECT_NEAR(step->time_s.back(), 3000.0, 1e-9);
  for (std::size_t i = 0; i < step->time_s.size(); ++i) {
    const double t_s = std::max(0.0, step->time_s[i]);
    EXPECT_NEAR(step->response_um[i], 20.0 * (1.0 - std::exp(-t_s / 600.0)), 0.5) << t_s << " s";
  }
  EXPECT_NEAR(step->response_um.back(), 19.865, 0.005);
}

// Medians 40 (of 38, 40, 43, the gap left out) and 20: the other input stays there.
TEST(step_response, leaves_the_other_inputs_at_their_median) {
  Series data = warming();
  data.columns.push_back({"T_bed_degC", Role::structure, {38, 40, std::nan(""), 43}});
  const Term term = term_of("gradient_bending", {"T_degC", "T_bed_degC"});
  const std::vector<FittedParameter> one(term.effect->parameters.size(), value(1.0));
  const auto first = step_response(term, one, 0, data), second = step_response(term, one, 1, data);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(second->from, 38.0);
  EXPECT_EQ(second->to, 43.0);
  // Of a difference: what the one input raises the other lowers, 10 K against 5 K.
  const double of_first = first->response_um.back() - first->response_um.front();
  const double of_second = second->response_um.back() - second->response_um.front();
  EXPECT_NEAR(of_first, -2.0 * of_second, 1e-9 * std::abs(of_first));
  EXPECT_GT(std::abs(of_first), 1.0);
}

TEST(step_response, of_what_stands_still_or_is_not_known_is_none) {
  const FittedParameter gain[] = {value(2.0)};
  const Term term = term_of("expansion", {"T_degC"});
  Series still = warming();
  still.columns[0].values = {20, 20, 20, 20};
  EXPECT_FALSE(step_response(term, gain, 0, still));
  still.columns[0].values.assign(4, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(step_response(term, gain, 0, still));
  still.columns.clear();
  EXPECT_FALSE(step_response(term, gain, 0, still));
}

}  // namespace
}  // namespace ballbar
