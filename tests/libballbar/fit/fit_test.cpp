#include "ballbar/fit/fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

// Rows of 60 s: a start, a stop, and a room that follows its own way.
Series duty_cycle(std::size_t n) {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      body{"T_body_degC", Role::bearing, {}};
  double bearing = 20.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double time_s = 60.0 * static_cast<double>(i);
    data.time_s.push_back(time_s);
    const double rpm = i % 240 < 120 ? 0.0 : 2000.0 * static_cast<double>(i / 240 + 1);
    speed.values.push_back(rpm);
    bearing += (20.0 + rpm / 500.0 - bearing) * 0.03;
    body.values.push_back(bearing);
    room.values.push_back(20.0 + 2.0 * std::sin(time_s / 9000.0));
  }
  data.columns = {speed, room, body};
  return data;
}

void add_target(Series& data, const std::vector<double>& values, const char* name = "z_um") {
  data.columns.push_back({name, Role::measured, values});
}

Model model_of(std::vector<Term> terms) {
  Model model;
  model.targets = {"z_um"};
  model.terms = std::move(terms);
  return model;
}

const FittedParameter& parameter_of(const Fit& fit, const std::string& name) {
  for (const FittedParameter& parameter : fit.parameters) {
    if (parameter.name == name) return parameter;
  }
  throw Error("no parameter " + name);
}

// y = 5 + 2 (T - T0) with T - T0 = 0, 1, 2, 3 and errors 0.1, -0.1, -0.1, 0.1: normal equations by hand.
// sum of T: 6, of T^2: 14, of y: 5 + 7 + 9 + 11 = 32, of T y: 0 + 6.9 + 17.8 + 33.3 = 58.0; n = 4.
// slope = (4 * 58 - 6 * 32) / (4 * 14 - 36) = 40 / 20 = 2, constant = (32 - 12) / 4 = 5.
// Residuals as the errors: sum of squares 0.04, variance 0.04 / 2 = 0.02, var(slope) = 0.02 / 5 = 0.004.
TEST(fit, linear_regression_by_hand) {
  Series data;
  data.time_s = {0.0, 60.0, 120.0, 180.0};
  data.columns.push_back({"T_degC", Role::structure, {20.0, 21.0, 22.0, 23.0}});
  add_target(data, {5.1, 6.9, 8.9, 11.1});
  const Fit found = fit(model_of({term_of("expansion", {"T_degC"})}), data);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.parameters[0].value, 5.0, 1e-8);
  EXPECT_NEAR(found.parameters[1].value, 2.0, 1e-8);
  EXPECT_NEAR(found.parameters[1].sigma, std::sqrt(0.004), 1e-8);
  // var(constant) = 0.02 (1/4 + 1.5^2 / 5) = 0.014, covariance = -0.02 * 1.5 / 5 = -0.006
  EXPECT_NEAR(found.parameters[0].sigma, std::sqrt(0.014), 1e-8);
  EXPECT_NEAR(found.covariance(0, 1), -0.006, 1e-8);
  EXPECT_NEAR(found.rmse_um, 0.1, 1e-8);
  EXPECT_NEAR(found.contribution_um[0][3], 6.0, 1e-8);
  EXPECT_NEAR(found.residual_um[1], -0.1, 1e-8);
}

TEST(fit, rows_without_a_target_still_move_what_has_a_memory) {
  Series data = duty_cycle(600);
  const Model truth = model_of({term_of("speed_heating", {"speed_rpm"})});
  const std::vector<double> exact = predict(
                                        truth,
                                        [&] {
                                          std::vector<FittedParameter> parameters(4);
                                          parameters[0].value = 1.0;
                                          parameters[1].value = 0.8;
                                          parameters[2].value = 2500.0;
                                          parameters[3].value = 5.0 / 3.0;
                                          return parameters;
                                        }(),
                                        data)
                                        .predicted_um;
  std::vector<double> sparse(exact.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < sparse.size(); i += 25) sparse[i] = exact[i];
  add_target(data, sparse);
  const Fit found = fit(truth, data);
  EXPECT_EQ(found.residual_um.size(), 24U);
  EXPECT_NEAR(parameter_of(found, "time_constant_s").value, 2500.0, 1e-3);
  EXPECT_NEAR(found.parameters[1].value, 0.8, 1e-7);
  EXPECT_NEAR(found.parameters[0].value, 1.0, 1e-6);
  EXPECT_EQ(parameter_of(found, "exponent").state, ParameterState::held);
}

TEST(fit, sigma_of_the_target_weighs) {
  Series data;
  data.time_s = {0.0, 1.0, 2.0};
  add_target(data, {1.0, 1.0, 4.0});
  data.columns.push_back({"z_sigma_um", Role::measured, {0.1, 0.1, 1.0}});
  Model constant = model_of({});
  const Fit found = fit(constant, data);
  // weights 100, 100, 1: (100 + 100 + 4) / 201
  EXPECT_NEAR(found.parameters[0].value, 204.0 / 201.0, 1e-8);  // the solver stops where the cost is flat to 1e-10
  EXPECT_EQ(found.sigma_um, (std::vector<double>{0.1, 0.1, 1.0}));
}

TEST(fit, sigma_is_not_below_what_is_stated) {
  Series data;
  for (int i = 0; i < 10; ++i) data.time_s.push_back(i);
  add_target(data, std::vector<double>(10, 3.0));
  data.columns.push_back({"z_sigma_um", Role::measured, std::vector<double>(10, 0.5)});
  EXPECT_NEAR(fit(model_of({}), data).parameters[0].sigma, 0.5 / std::sqrt(10.0), 1e-9);
}

TEST(fit, undetermined_parameters_are_said) {
  Series data = duty_cycle(100);  // the spindle never turns in the first 120 rows
  std::vector<double> target;
  for (std::size_t i = 0; i < 100; ++i) target.push_back(std::sin(static_cast<double>(i)));
  add_target(data, target);
  const Fit found = fit(model_of({term_of("speed_heating", {"speed_rpm"})}), data);
  EXPECT_EQ(found.parameters[1].state, ParameterState::undetermined);
  EXPECT_TRUE(std::isinf(found.parameters[1].sigma));
  ASSERT_FALSE(found.remarks.empty());
  EXPECT_EQ(text_of(found.remarks.front()),
            "The data do not determine gain_um_per_krpm_a of speed_heating(speed_rpm).");
}

TEST(fit, two_effects_that_are_the_same_here_are_undetermined) {
  Series data = duty_cycle(400);
  data.columns.push_back({"T_twin_degC", Role::structure, data.columns[2].values});
  std::vector<double> target;
  for (std::size_t i = 0; i < 400; ++i)
    target.push_back(data.columns[2].values[i] + 0.1 * std::cos(7.0 * static_cast<double>(i)));
  add_target(data, target);
  const Fit found = fit(model_of({term_of("expansion", {"T_body_degC"}), term_of("expansion", {"T_twin_degC"})}), data);
  EXPECT_EQ(found.parameters[1].state, ParameterState::undetermined);
  EXPECT_EQ(found.parameters[2].state, ParameterState::undetermined);
  EXPECT_EQ(found.parameters[0].state, ParameterState::free);
  EXPECT_LT(found.rmse_um, 0.08);
}

TEST(fit, a_bound_holds_and_is_said) {
  Series data = duty_cycle(400);
  std::vector<double> target;
  for (const double value : data.columns[2].values) target.push_back(2.0 * (value - 20.0));
  add_target(data, target);
  Model model = model_of({term_of("expansion", {"T_body_degC"})});
  model.terms[0].settings[0].upper = 1.5;
  const Fit found = fit(model, data);
  EXPECT_NEAR(found.parameters[1].value, 1.5, 1e-6);
  EXPECT_EQ(found.parameters[1].state, ParameterState::on_upper_bound);
  EXPECT_TRUE(std::isnan(found.parameters[1].sigma));
}

TEST(fit, held_parameters_stay) {
  Series data = duty_cycle(400);
  std::vector<double> target;
  for (const double value : data.columns[2].values) target.push_back(2.0 * (value - 20.0) + 7.0);
  add_target(data, target);
  Model model = model_of({term_of("expansion", {"T_body_degC"})});
  model.terms[0].settings[0].held = true;
  model.terms[0].settings[0].start = 2.0;
  const Fit found = fit(model, data);
  EXPECT_EQ(found.parameters[1].value, 2.0);
  EXPECT_EQ(found.parameters[1].state, ParameterState::held);
  EXPECT_NEAR(found.parameters[0].value, 7.0, 1e-9);
}

TEST(fit, robust_discounts_what_lies_apart) {
  Series data = duty_cycle(400);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::vector<double> target;
  for (std::size_t i = 0; i < 400; ++i) {
    target.push_back(0.7 * (data.columns[2].values[i] - 20.0) + noise(random) + (i % 20 == 7 ? 5.0 : 0.0));
  }
  add_target(data, target);
  const Model model = model_of({term_of("expansion", {"T_body_degC"})});
  FitOptions robust;
  robust.robust = true;
  robust.white = true;
  const Fit found = fit(model, data, 0, robust);
  EXPECT_NEAR(found.parameters[1].value, 0.7, 4.0 * found.parameters[1].sigma);
  EXPECT_NEAR(found.parameters[0].value, 0.0, 0.05);
  ASSERT_EQ(found.discounted.size(), 20U);
  EXPECT_EQ(found.discounted[1], 27U);
  EXPECT_NEAR(found.rmse_um, 0.1, 4.0 * 0.1 / std::sqrt(760.0)) << "of the 380 that are kept";
  EXPECT_NEAR(found.n_effective, 380.0, 1e-9);
  EXPECT_EQ(text_of(found.floor.source), "error of predicting the next reading");
  EXPECT_NEAR(found.floor.rms_um, found.rmse_um, 0.002);
  EXPECT_TRUE(found.remarks.empty());
}

// A fault of the logger is in no figure of the fit, and a step or a ramp is none.
TEST(fit, readings_far_from_their_neighbours_are_set_aside) {
  Series data = duty_cycle(400);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::vector<double> target;
  for (std::size_t i = 0; i < 400; ++i) {
    const bool is_far = i == 1 || i == 90 || i == 91 || i == 398;
    target.push_back(0.7 * (data.columns[2].values[i] - 20.0) + noise(random) + (is_far ? 300.0 : 0.0) +
                     (i >= 200 ? 9.0 : 0.0) + 0.05 * static_cast<double>(i));
  }
  add_target(data, target);
  Model model = model_of({term_of("expansion", {"T_body_degC"}), term_of("step", {}), term_of("linear_drift", {})});
  const Fit found = fit(model, data);
  EXPECT_EQ(found.set_aside, (std::vector<std::size_t>{1, 90, 91, 398}));
  EXPECT_EQ(found.row.size(), 396U);
  EXPECT_LT(found.rmse_um, 0.12);
  EXPECT_LT(found.floor.rms_um, 0.12);
  FitOptions robust;
  robust.robust = true;
  EXPECT_TRUE(fit(model, data, 0, robust).set_aside.empty());
}

// z = 0.7 (T - T0) + noise of 0.1 um, one value in twenty 1 um off: AR(1) with lag-1 correlation phi, or white (0).
struct Contaminated {
  double phi = 0.0;
  bool outliers = false;
};

void PrintTo(const Contaminated& one, std::ostream* out) {
  *out << "phi " << one.phi << (one.outliers ? ", outliers" : "");
}

class RobustFit : public testing::TestWithParam<Contaminated> {};

// Slope and constant are within 1.96 sigma in 95 % of the seeds: binomial of 400 (two parameters of 200 seeds), whose
// sigma is 1.1 % for independent ones and 1.5 % if the two were the same; within 3 of these. A memory is itself
// estimated, which costs a fit without outliers 1 % too.
TEST_P(RobustFit, intervals_cover) {
  constexpr std::size_t kRows = 300;
  constexpr std::uint64_t kSeeds = 200;
  const Model model = model_of({term_of("expansion", {"T_body_degC"})});
  FitOptions robust;
  robust.robust = true;
  int covered = 0;
  std::size_t found_outliers = 0, discounted = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Series data = duty_cycle(kRows);
    std::mt19937_64 random(5000 + seed);
    std::normal_distribution<double> normal;
    std::vector<double> target;
    double s = normal(random);
    for (std::size_t i = 0; i < kRows; ++i) {
      if (i > 0) s = GetParam().phi * s + std::sqrt(1.0 - GetParam().phi * GetParam().phi) * normal(random);
      const bool off = GetParam().outliers && i % 20 == 7;
      target.push_back(0.7 * (data.columns[2].values[i] - 20.0) + 0.1 * s + (off ? (i % 40 == 7 ? 1.0 : -1.0) : 0.0));
    }
    add_target(data, target);
    const Fit found = fit(model, data, 0, robust);
    covered += std::abs(found.parameters[0].value) < 1.96 * found.parameters[0].sigma ? 1 : 0;
    covered += std::abs(found.parameters[1].value - 0.7) < 1.96 * found.parameters[1].sigma ? 1 : 0;
    discounted += found.discounted.size();
    for (const std::size_t row : found.discounted) found_outliers += row % 20 == 7 ? 1 : 0;
  }
  EXPECT_NEAR(covered / 400.0, GetParam().phi > 0.0 ? 0.94 : 0.95, 0.045);
  if (GetParam().outliers) {
    EXPECT_EQ(found_outliers, kSeeds * kRows / 20);
  }
  if (!GetParam().outliers) found_outliers = 0;
  // |r| > 3.87 s by chance: one in ten thousand, more as s is itself an estimate.
  EXPECT_LT(discounted - found_outliers, kSeeds * kRows / 1000);
}

INSTANTIATE_TEST_SUITE_P(fit, RobustFit,
                         testing::Values(Contaminated{0.0, false}, Contaminated{0.0, true}, Contaminated{0.7, false},
                                         Contaminated{0.7, true}));

// 1.8 um is nine times what AR(1) noise of 1 um, phi = 0.98, does from row to row (0.2 um), and not much in all: only
// the filter sees it. The rows after it are not discounted with it.
TEST(fit, robust_sees_what_lies_apart_from_its_neighbours) {
  Series data = duty_cycle(600);
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  std::vector<double> target;
  double s = 0.0;
  for (std::size_t i = 0; i < 600; ++i) {
    s = 0.98 * s + std::sqrt(1.0 - 0.98 * 0.98) * normal(random);
    target.push_back(0.7 * (data.columns[2].values[i] - 20.0) + s + (i % 60 == 30 ? 1.8 : 0.0));
  }
  add_target(data, target);
  FitOptions robust;
  robust.robust = true;
  const Fit found = fit(model_of({term_of("expansion", {"T_body_degC"})}), data, 0, robust);
  EXPECT_EQ(found.discounted, (std::vector<std::size_t>{30, 90, 150, 210, 270, 330, 390, 450, 510, 570}));
  EXPECT_LT(found.noise.white_um, 0.1);
  EXPECT_NEAR(found.floor.rms_um, 0.2, 4.0 * 0.2 / std::sqrt(1200.0));
}

// As many parameters as values: nothing tells sigma, unless it is stated. Two more values tell it.
TEST(fit, sigma_of_a_saturated_fit_is_not_known) {
  const Model model = model_of({term_of("expansion", {"T_degC"})});
  Series data;
  data.time_s = {0.0, 60.0, 120.0};
  data.columns.push_back({"T_degC", Role::structure, {20.0, 21.0, 22.5}});
  add_target(data, {5.0, 7.0, 10.001});
  const Fit found = fit(model, data);
  EXPECT_NEAR(found.parameters[1].value, 2.0, 0.01);
  for (const FittedParameter& parameter : found.parameters) {
    EXPECT_EQ(parameter.state, ParameterState::free);
    EXPECT_TRUE(std::isnan(parameter.sigma)) << parameter.name;
  }
  ASSERT_FALSE(found.remarks.empty());
  EXPECT_EQ(text_of(found.remarks[0]),
            "3 values for 2 free parameters leave too little to tell sigma: it is not known.");
  data.columns.push_back({"z_sigma_um", Role::measured, {0.1, 0.1, 0.1}});
  // var(slope) = 0.01 / sum (T - mean T)^2 = 0.01 / (1.1667^2 + 0.1667^2 + 1.3333^2) = 0.01 / 3.1667
  EXPECT_NEAR(fit(model, data).parameters[1].sigma, std::sqrt(0.01 / (19.0 / 6.0)), 1e-8);
}

TEST(fit, time_constant_far_from_the_start_is_found) {
  Series data = duty_cycle(1500);
  const Model truth = model_of({term_of("lagged_expansion", {"T_room_degC"}), term_of("speed_heating", {"speed_rpm"})});
  std::vector<FittedParameter> p(6);
  const double values[] = {0.5, 3.0, 30000.0, 0.6, 400.0, 5.0 / 3.0};
  for (std::size_t k = 0; k < 6; ++k) p[k].value = values[k];
  std::vector<double> target = predict(truth, p, data).predicted_um;
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.05);
  for (double& value : target) value += noise(random);
  add_target(data, target);
  const Fit found = fit(truth, data);
  EXPECT_NEAR(found.parameters[2].value, 30000.0, 3000.0);
  EXPECT_NEAR(found.parameters[4].value, 400.0, 40.0);
}

// A jump of 1 um at 3000 s, and a dip of 3 um behind it that the model lacks. A step that is free to move goes to the
// end of the dip, 13 rows away.
TEST(fit, a_stated_jump_stays_at_its_row) {
  Series data;
  std::vector<double> z_um;
  for (int i = 0; i < 100; ++i) {
    data.time_s.push_back(60.0 * i);
    z_um.push_back((i > 50 ? 1.0 : 0.0) - 3.0 * std::exp(-std::pow((i - 55) / 8.0, 2)) + 0.01 * std::sin(i * i));
  }
  add_target(data, z_um);
  Term step = term_of("step", {});
  step.settings[1].stated = true;
  for (const auto& [start_s, low_s, high_s] : {std::array{3000.0, 2970.0, 3030.0}, {3010.0, 3000.0, 3060.0}}) {
    step.settings[1].start = start_s;
    const FittedParameter onset = parameter_of(fit(model_of({step}), data), "onset_s");
    EXPECT_GE(onset.value, low_s);
    EXPECT_LE(onset.value, high_s);
    EXPECT_EQ(onset.state, ParameterState::free);
  }
}

TEST(fit, sigma_grows_with_the_memory_of_the_noise) {
  Series data = duty_cycle(1200);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> white, red;
  double memory = 0.0;
  for (std::size_t i = 0; i < 1200; ++i) {
    memory = 0.95 * memory + std::sqrt(1.0 - 0.95 * 0.95) * normal(random);
    white.push_back(normal(random));
    red.push_back(memory);
  }
  Series quiet = data, loud = data;
  add_target(quiet, white);
  add_target(loud, red);
  const Model model = model_of({term_of("expansion", {"T_room_degC"})});
  const Fit of_white = fit(model, quiet), of_red = fit(model, loud);
  EXPECT_GT(of_red.parameters[1].sigma, 3.0 * of_white.parameters[1].sigma);
  EXPECT_LT(of_red.n_effective, 0.2 * 1200.0);
  EXPECT_GT(of_white.n_effective, 0.7 * 1200.0);
}

TEST(fit, too_many_parameters_are_said) {
  Series data = duty_cycle(400);
  std::vector<double> sparse(400, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < 400; i += 100) sparse[i] = std::sin(static_cast<double>(i));
  add_target(data, sparse);
  const Fit found =
      fit(model_of({term_of("lagged_expansion", {"T_room_degC"}), term_of("lagged_expansion", {"T_body_degC"})}), data);
  bool said = false;
  for (const std::string& remark : texts_of(found.remarks)) {
    said = said || remark == "5 free parameters for 4.0 independent samples (of 4): too many for these data.";
  }
  EXPECT_TRUE(said);
}

TEST(fit, fails_with_a_sentence) {
  Series data = duty_cycle(10);
  add_target(data, {1.0, 2.0});
  data.columns.back().values.resize(10, std::numeric_limits<double>::quiet_NaN());
  try {
    fit(model_of({}), data);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "expected at least 3 values of z_um, found 2.");
  }
}

TEST(fit, prediction_adds_up) {
  Series data = duty_cycle(300);
  std::vector<double> target;
  for (std::size_t i = 0; i < 300; ++i) target.push_back(static_cast<double>(i % 17));
  add_target(data, target);
  const Model model = model_of({term_of("expansion", {"T_body_degC"}), term_of("lagged_expansion", {"T_room_degC"})});
  const Fit found = fit(model, data);
  const Prediction prediction = predict(model, found.parameters, data);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_NEAR(prediction.predicted_um[i], found.predicted_um[i], 1e-9);
    EXPECT_NEAR(prediction.predicted_um[i],
                found.parameters[0].value + prediction.contribution_um[0][i] + prediction.contribution_um[1][i], 1e-9);
  }
}

}  // namespace
}  // namespace ballbar
