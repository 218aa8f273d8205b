#include "ballbar/internal/predict/growth.hpp"

#include <gtest/gtest.h>

#include "ballbar/fit/fit.hpp"
#include "ballbar/predict/train.hpp"
#include "made_runs.hpp"

namespace ballbar {
namespace {

Model constant_alone() {
  Model model;
  model.targets = {"z_um"};
  return model;
}

// RMSE of the model with the terms of the last revision, fitted to the data.
double rmse_um(const Model& base, const Growth& grown, const Series& data) {
  Model model = base;
  if (!grown.revisions.empty()) {
    const std::vector<Term>& terms = grown.revisions.back().terms;
    model.terms.insert(model.terms.end(), terms.begin(), terms.end());
  }
  return fit(model, data).rmse_um;
}

TEST(Growth, grows_until_it_predicts_what_all_effects_do) {
  const Series data = made::run({.rows = 300}, "growth");
  const Growth grown = growth(constant_alone(), data);
  ASSERT_FALSE(grown.revisions.empty());
  const GrowthErrors& before = grown.errors.front();
  const GrowthErrors& last = grown.errors[grown.revisions.size()];
  EXPECT_LT(last.forecast_um, 0.2 * before.forecast_um);
  EXPECT_LT(last.forecast_um, 1.5 * grown.all_um);
  EXPECT_EQ(last.effects, grown.revisions.back().terms.size());
  std::size_t joined = 0;
  for (const GrownRevision& revision : grown.revisions) {
    joined += revision.joined.size();
    EXPECT_EQ(joined, revision.terms.size());
  }
}

// What is written leaves what is said, also where the model holds its constant.
TEST(Growth, says_the_error_of_what_it_writes) {
  const Series data = made::run({.rows = 300}, "written");
  for (const bool is_held : {false, true}) {
    Model base = constant_alone();
    base.terms.push_back(term_of("expansion", {"T_front_degC"}));
    if (is_held) base.constant_um = 0.0;
    const Growth grown = growth(base, data);
    ASSERT_FALSE(grown.revisions.empty());
    EXPECT_NEAR(rmse_um(base, grown, data), grown.errors[grown.revisions.size()].rmse_um, 0.1) << is_held;
  }
}

TEST(Growth, of_noise_keeps_nothing) {
  Series data = made::run({.rows = 240}, "noise");
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (double& value : data.columns.back().values) value = normal(random);
  const Growth grown = growth(constant_alone(), data);
  EXPECT_TRUE(grown.revisions.empty());
  EXPECT_EQ(grown.stop, GrowthStop::no_better);
}

TEST(Growth, of_few_rows_is_not_tested) {
  const Growth grown = growth(constant_alone(), made::run({.rows = 50}, "few"));
  EXPECT_TRUE(grown.revisions.empty());
  EXPECT_EQ(grown.stop, GrowthStop::untested);
}

// The base model's column moves in no row of the first forecast.
TEST(Growth, of_a_base_that_stands_still_at_first) {
  Series data = made::run({.rows = 240}, "still");
  Column cool{"T_cool_degC", Role::coolant, std::vector<double>(240, 20.0)};
  for (std::size_t i = 220; i < 240; ++i) cool.values[i] = 20.0 + 0.01 * static_cast<double>(i - 220);
  data.columns.insert(data.columns.begin(), cool);
  Model base = constant_alone();
  base.terms.push_back(term_of("expansion", {"T_cool_degC"}));
  EXPECT_FALSE(growth(base, data).revisions.empty());
  ASSERT_TRUE(predictability(base, data));
}

TEST(Predictability, has_the_forecasts_of_a_training) {
  const Series data = made::run({.rows = 240}, "predicted");
  const auto found = predictability(constant_alone(), data);
  ASSERT_TRUE(found);
  const Forecasts trained = *effect_regression({&data, 1}, "z_um").forecasts;
  EXPECT_EQ(found->forecasts.rmse_um, trained.rmse_um);
  EXPECT_GT(found->model_um, trained.rmse_um);
  EXPECT_TRUE(found->is_better);
}

TEST(Predictability, of_what_has_no_column_is_not_known) {
  Series data = made::run({.rows = 240}, "alone");
  data.columns.erase(data.columns.begin(), data.columns.end() - 1);
  EXPECT_FALSE(predictability(constant_alone(), data));
}

}  // namespace
}  // namespace ballbar
