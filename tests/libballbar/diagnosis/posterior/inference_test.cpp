// What readings do not tell is not weighed: rows at jumps, clocks that are late, readings far from the others.
#include "diagnosis/posterior/inference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "diagnosis/made_drift.hpp"
#include "diagnosis/outcome.hpp"
#include "diagnosis/signatures/thresholds.hpp"

namespace ballbar {
namespace {

ProblemOptions usual() {
  ProblemOptions options;
  options.search.catalogue = built_in_catalogue();
  return options;
}

std::size_t unknown_rows(const Problem& problem) {
  return static_cast<std::size_t>(std::count_if(problem.stated_variance.begin(), problem.stated_variance.end(),
                                                [](double one) { return one >= kUnknownVariance; }));
}

// Exact rows: every change of the speed is between two of them, and all tell.
TEST(Problem, of_exact_rows_knows_all) {
  const auto problem = problem_of(made::by_speed(), made::drift({1.0, 1, 200}), 0, usual());
  EXPECT_EQ(unknown_rows(*problem), 0U);
  for (const double one : problem->relative_variance) EXPECT_EQ(one, 1.0);
}

// About their mean, but where the model holds the constant that they are taken from.
TEST(Problem, takes_readings_about_their_mean) {
  Series data = made::drift({1.0, 1, 200});
  for (double& value : made::values_of(data, "z_um")) value += 1e6;
  const auto problem = problem_of(made::by_speed(), data, 0, usual());
  EXPECT_NEAR(problem->y.mean(), 0.0, 1e-6);
  EXPECT_NEAR(problem->centre_um, 1e6, 100.0);
  Model held = made::by_speed();
  held.constant_um = 1e6;
  EXPECT_EQ(problem_of(held, data, 0, usual())->centre_um, 0.0);
}

// Changes every 5400 s in rows of 100 s, of a logger that holds all inputs for four rows: three rows within each
// sample.
TEST(Problem, sets_rows_aside_in_whose_sample_an_input_changed) {
  Series data = made::drift({1.0, 1, 200});
  for (const char* name : {"speed_rpm", "T_room_degC", "T_bearing_degC"}) {
    std::vector<double>& values = made::values_of(data, name);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = values[i - i % 4];
  }
  const auto problem = problem_of(made::by_speed(), data, 0, usual());
  std::size_t within = 0;
  for (const LoggedInput& input : problem->logged.inputs) {
    if (!input.is_stepped) continue;
    for (const Jump& jump : input.jumps) {
      EXPECT_EQ(jump.last - jump.first, 4U);
      for (std::size_t row = jump.first + 1; row < jump.last; ++row, ++within)
        EXPECT_EQ(problem->stated_variance[row], kUnknownVariance) << row;
    }
  }
  EXPECT_EQ(within, 9U);
  EXPECT_EQ(unknown_rows(*problem), within);
}

// The room steps by 1.5 degC at row 211; in few rows one jump is no noise.
TEST(Problem, knows_the_rows_about_a_jump_of_a_temperature) {
  const auto rows_of = [](const Problem& problem) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < problem.at_jump_of_temperature.size(); ++i) {
      if (problem.at_jump_of_temperature[i] != 0) rows.push_back(i);
    }
    return rows;
  };
  const auto problem = problem_of(made::by_speed(), made::drift({1.0, 1, 300}), 0, usual());
  EXPECT_EQ(rows_of(*problem), (std::vector<std::size_t>{209, 210, 211, 212, 213}));
  Series few = made::drift({1.0, 1, 40});
  std::vector<double>& room = made::values_of(few, "T_room_degC");
  for (std::size_t i = 20; i < 40; ++i) room[i] += 8.0;
  EXPECT_EQ(rows_of(*problem_of(made::by_speed(), few, 0, usual())), (std::vector<std::size_t>{18, 19, 20, 21, 22}));
}

// Stated sigmas are relative: their mean square is 1, and what is known of the scatter is that mean.
TEST(Problem, takes_stated_sigmas) {
  Series data = made::drift({1.0, 1, 200});
  Column sigma{"z_sigma_um", Role::measured, {}};
  for (std::size_t i = 0; i < 200; ++i) sigma.values.push_back(i % 2 == 0 ? 0.1 : 0.3);
  data.columns.push_back(sigma);
  const auto problem = problem_of(made::by_speed(), data, 0, usual());
  EXPECT_NEAR(problem->known.variance, 0.05, 1e-12);
  EXPECT_NEAR(problem->relative_variance[0], 0.2, 1e-12);
  EXPECT_NEAR(problem->relative_variance[1], 1.8, 1e-12);
}

// A few readings 20 times the noise off are set aside, no others.
TEST(Inference, readings_far_from_the_others_are_set_aside) {
  Series data = made::drift({1.0, 1, 300});
  const std::vector<std::size_t> far{50, 101, 180, 251};
  for (const std::size_t row : far) made::values_of(data, "z_um")[row] += row % 2 == 0 ? 6.0 : -6.0;
  const Inference found = inference(made::by_speed(), data, 0, usual());
  EXPECT_EQ(found.problem->base.set_aside, far);
  EXPECT_EQ(found.problem->time_s.size(), 296U);
  std::size_t others = 0;
  for (const double one : found.problem->relative_variance) others += one > 1.0 ? 1 : 0;
  EXPECT_LE(others, 12U);
  const Diagnosis without = diagnose(made::by_speed(), made::drift({1.0, 1, 300}));
  const Diagnosis with = diagnose(made::by_speed(), data);
  ASSERT_FALSE(with.effects.empty());
  ASSERT_FALSE(without.effects.empty());
  EXPECT_EQ(label_of(with.effects.front().bound), label_of(without.effects.front().bound));
  EXPECT_GE(with.effects.front().p, kProbable) << made::outcome_of(with);
}

// Beside readings that are far off a step of the readings stays one.
TEST(Inference, a_jump_that_stays_is_no_reading_far_from_the_others) {
  Series data = made::drift({0.0, 1, 300});
  std::vector<double>& values = made::values_of(data, "z_um");
  for (const std::size_t row : {50, 101, 251}) values[row] += 6.0;
  for (std::size_t row = 150; row < 300; ++row) values[row] += 6.0;
  const Inference found = inference(made::by_speed(), data, 0, usual());
  EXPECT_EQ(found.problem->base.set_aside, (std::vector<std::size_t>{50, 101, 251}));
  EXPECT_TRUE(std::all_of(found.problem->stated_variance.begin(), found.problem->stated_variance.end(),
                          [](double variance) { return variance == 0.0; }));
  const EffectSet& best = found.posterior.sets[found.posterior.best];
  ASSERT_EQ(best.families.size(), 1U);
  EXPECT_EQ(found.problem->library.families[best.families[0]].bound.effect->name, "step");
  EXPECT_NEAR(found.problem->library.signatures[best.signatures[0]].point[1], 14900.0, 100.0);
}

// Of 3000 values every third is weighed, and about a jump all: its moment is that of a row.
TEST(Inference, every_value_about_a_jump) {
  Series data = made::drift({0.0, 1, 3000});
  std::vector<double>& values = made::values_of(data, "z_um");
  for (std::size_t row = 1501; row < 3000; ++row) values[row] += 4.0;
  const Inference found = inference(made::by_speed(), data, 0, usual());
  EXPECT_GT(found.problem->time_s.size(), 1005U);
  EXPECT_LT(found.problem->time_s.size(), 1020U);
  const EffectSet& best = found.posterior.sets[found.posterior.best];
  ASSERT_EQ(best.families.size(), 1U);
  EXPECT_NEAR(found.problem->library.signatures[best.signatures[0]].point[1], 150000.0, 100.0);
}

TEST(Inference, normal_readings_all_count_alike) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Inference found = inference(made::by_speed(), made::drift({0.0, seed, 300}), 0, usual());
    for (const double one : found.problem->relative_variance) EXPECT_EQ(one, 1.0) << seed;
  }
}

// What is asked for is there, however improbable.
TEST(Inference, has_a_set_that_is_asked_for) {
  const BoundEffect drift{find_effect("step", Level::series), {}};
  const BoundEffect bearing{find_effect("expansion", Level::series), {"T_bearing_degC"}};
  const BoundEffect room{find_effect("lagged_expansion", Level::series), {"T_room_degC"}};
  Inference found = inference(made::by_speed(), made::drift({3.0, 1, 200}), 0, usual());
  for (const std::vector<BoundEffect>& wanted :
       {std::vector<BoundEffect>{bearing}, {drift, bearing}, {bearing, drift, room}}) {
    std::vector<std::size_t> families;
    for (const BoundEffect& one : wanted) families.push_back(family_of(*found.problem, one).value());
    std::sort(families.begin(), families.end());
    EXPECT_TRUE(std::isfinite(log_bayes_factor(*found.problem, found.posterior, families))) << wanted.size();
    const std::size_t place = set_of(*found.problem, found.posterior, families);
    EXPECT_EQ(found.posterior.sets[place].families, families);
    EXPECT_EQ(set_of(*found.problem, found.posterior, families), place);  // it is there now
  }
}

// Readings are likelier with what is there, and less likely with what is not.
TEST(Inference, bayes_factor_is_for_what_is_there) {
  const Inference found = inference(made::by_speed(), made::drift({3.0, 1, 200}), 0, usual());
  const auto factor = [&](const char* name, std::vector<std::string> columns) {
    const auto family = family_of(*found.problem, {find_effect(name, Level::series), std::move(columns)});
    return log_bayes_factor(*found.problem, found.posterior, {family.value()});
  };
  EXPECT_GT(factor("lagged_expansion", {"T_room_degC"}), kLeastLikelihoodRatio);
  EXPECT_LT(factor("expansion", {"T_bearing_degC"}), 2.0);
}

}  // namespace
}  // namespace ballbar
