// Tests of one member of a set, on eight white readings worked by hand; a set fitted, against a regression.
#include "diagnosis/verdict/member_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "diagnosis/made_drift.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "diagnosis/verdict/fitted_set.hpp"

namespace ballbar {
namespace {

// The model a constant, scatter of 1 um, known; a column g = (1, -1, 1, -1 | 1, -1, 1, -1) in two cycles, and readings
// that follow it by the gain a in the first and by b in the second.
struct Eight {
  SetRegression at;
  std::vector<std::size_t> fold{0, 0, 0, 0, 1, 1, 1, 1};

  Eight(double a, double b) {
    Eigen::MatrixXd g(8, 1);
    g << 1, -1, 1, -1, 1, -1, 1, -1;
    LinearModel model;
    model.columns.resize(8, 3);
    model.columns << g, Eigen::MatrixXd::Ones(8, 1), g;
    model.columns.col(0).head(4) *= a;
    model.columns.col(0).tail(4) *= b;
    model.is_flat = {1, 1};
    const std::vector<double> time_s{0, 1, 2, 3, 4, 5, 6, 7};
    at = set_regression(Whitening(Covariance{}, time_s), std::move(model), {1}, {});
    at.solution.variance = 1.0;
  }
  Candidate tests() const { return with_tests({}, *find_effect("expansion", Level::series), at, 0, fold); }
};

// chi^2 = 4 (a - m)^2 + 4 (b - m)^2 = 2 (a - b)^2, one degree of freedom: p = erfc(|a - b|).
TEST(MemberTests, gains_of_two_cycles) {
  for (const auto& [a, b] : {std::pair{3.0, 3.0}, {3.0, 2.5}, {3.0, 1.0}, {3.0, -3.0}})
    EXPECT_NEAR(Eight(a, b).tests().p_same_gain, std::erfc(std::abs(a - b)), 1e-9) << a << " " << b;
}

// A cycle left out, the other one tells the gain: b of variance 1/4. What is predicted of the first along g, of length
// 2, is off by 2 (a - b) with variance 1 + 4/4: ln p = - (a - b)^2 - 1/2 ln 2, and without the effect - 2 a^2. 1e-2 for
// what a hair of prior holds back.
TEST(MemberTests, cycles_left_out) {
  const double a = 3.0, b = 2.0;
  const Candidate tests = Eight(a, b).tests();
  const double first = 2.0 * a * a - (a - b) * (a - b) - 0.5 * std::log(2.0);
  const double second = 2.0 * b * b - (a - b) * (a - b) - 0.5 * std::log(2.0);
  EXPECT_NEAR(tests.held_out_evidence, std::min(first, second), 1e-2);
  EXPECT_NEAR(tests.held_out_before_um, std::sqrt((a * a + b * b) / 2.0), 1e-3);
  EXPECT_NEAR(tests.held_out_after_um, std::abs(a - b), 1e-3);
}

TEST(MemberTests, doubts) {
  const Effect& expansion = *find_effect("expansion", Level::series);
  Candidate passed;
  passed.likelihood_ratio = kLeastLikelihoodRatio;
  passed.amplitude_um = 5.1;
  passed.amplitude_sigma_um = 1.0;
  passed.held_out_evidence = 10.0;
  EXPECT_TRUE(doubts_of(passed, expansion).empty());
  Candidate small = passed;
  small.amplitude_sigma_um = 1.1;
  EXPECT_EQ(doubts_of(small, expansion), std::vector{Doubt::uncertain_size});
  small = passed;
  small.likelihood_ratio = kLeastLikelihoodRatio - 0.1;
  EXPECT_EQ(doubts_of(small, expansion), std::vector{Doubt::weak_evidence});
  Candidate failed = passed;
  failed.held_out_evidence = 0.0;
  failed.p_same_gain = 0.5 * Tuning{}.same_gain;
  EXPECT_EQ(doubts_of(failed, expansion), (std::vector{Doubt::gain_differs, Doubt::not_predictive}));
  const Effect& slip = *find_effect("mounting_slip", Level::recording);
  EXPECT_EQ(doubts_of(failed, slip).front(), Doubt::gain_differs);
}

// A drift is no cause that one run could tell; a jump happens once, and a cycle repeats.
TEST(MemberTests, what_goes_with_time_alone) {
  Candidate sure;
  sure.likelihood_ratio = kLeastLikelihoodRatio;
  EXPECT_EQ(doubts_of(sure, *find_effect("settling", Level::series)), std::vector{Doubt::time_alone});
  EXPECT_TRUE(doubts_of(sure, *find_effect("step", Level::series)).empty());
  EXPECT_TRUE(doubts_of(sure, *find_effect("thermostat_cycle", Level::series)).empty());
}

// 24 values of a curve with noise, fitted by one effect.
struct FittedAlone {
  Series data;
  FittedSet set;

  FittedAlone(const std::string& effect, double (*curve)(int)) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    Column target{"z_um", Role::measured, {}};
    for (int i = 0; i < 24; ++i) {
      data.time_s.push_back(600.0 * i);
      target.values.push_back(curve(i) + normal(random));
    }
    data.columns = {target};
    Model constant;
    constant.targets = {"z_um"};
    ProblemOptions options;
    options.search.catalogue = built_in_catalogue();
    options.terms = {term_of(effect, {})};
    Inference found = inference(constant, data, 0, options);
    const auto family = family_of(*found.problem, {find_effect(effect, Level::series), {}}).value();
    set = fitted_set(*found.problem, found.posterior,
                     found.posterior.sets[set_of(*found.problem, found.posterior, {family})], false);
  }
};

// A straight line of time: slope and sigma of the textbook, S_xy / S_xx and sqrt(S / (n - 2) / S_xx).
TEST(FittedSet, is_a_regression_where_the_scatter_is_white) {
  const FittedAlone alone("linear_drift", [](int i) { return 5.0 + 2.0 * i / 6.0; });
  const FittedSet& fitted = alone.set;
  const Eigen::VectorXd y = Eigen::VectorXd::Map(alone.data.columns.front().values.data(), 24);
  const Eigen::VectorXd hours = Eigen::VectorXd::Map(alone.data.time_s.data(), 24) / 3600.0;
  const Eigen::VectorXd x = hours.array() - hours.mean();
  const double sxx = x.squaredNorm(), slope = x.dot(y) / sxx;
  const Eigen::VectorXd left = y.array() - y.mean() - slope * x.array();
  const double sigma = std::sqrt(left.squaredNorm() / 22.0 / sxx);
  ASSERT_EQ(fitted.parameters.size(), 2U);
  EXPECT_NEAR(fitted.parameters[1].value, slope, 1e-6);
  EXPECT_NEAR(fitted.parameters[1].sigma, sigma, 1e-6);
  EXPECT_NEAR(fitted.intervals[1].low, slope - 1.96 * sigma, 1e-4);
  EXPECT_NEAR(fitted.intervals[1].high, slope + 1.96 * sigma, 1e-4);
  EXPECT_NEAR(fitted.amplitude_um[0], slope * (hours[23] - hours[0]), 1e-6);
  EXPECT_NEAR(fitted.amplitude_sigma_um[0], sigma * (hours[23] - hours[0]), 1e-6);
}

// The moment of a jump, which is free, does not add to the sigma of its size.
TEST(FittedSet, sigma_of_the_amplitude_of_a_jump_is_that_of_its_size) {
  const FittedSet fitted = FittedAlone("step", [](int i) { return i < 12 ? 0.0 : 20.0; }).set;
  EXPECT_NEAR(fitted.amplitude_um[0], std::abs(fitted.parameters[1].value), 1e-9);
  EXPECT_NEAR(fitted.amplitude_sigma_um[0], fitted.parameters[1].sigma, 1e-6);
}

}  // namespace
}  // namespace ballbar
