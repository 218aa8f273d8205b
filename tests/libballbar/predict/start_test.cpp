// A regression with effects of a model among its own, and one that starts from another.
#include <gtest/gtest.h>

#include "ballbar/error.hpp"
#include "ballbar/predict/train.hpp"
#include "made_runs.hpp"

namespace ballbar {
namespace {

double rmse_um(const EffectRegression& regression, const Series& run) {
  return error_of(predict(regression, run), find_column(run, "z_um")->values)->rmse_um;
}

Model with(const char* effect, const char* column) {
  Model model;
  model.targets = {"z_um"};
  model.terms.push_back(term_of(effect, {column}));
  return model;
}

TEST(Named, effects_that_help_are_told_with_their_share) {
  // A cause whose gain is far from the others': a body that follows the base, and nothing else.
  Series run = made::run({.rows = 300, .noise_um = 0.1}, "named");
  const std::vector<double>& base = find_column(run, "T_base_degC")->values;
  made::Lag lag(3000.0, 30.0);
  for (std::size_t i = 0; i < base.size(); ++i) run.columns.back().values[i] += 40.0 * lag.next(base[i] - base[0]);
  EffectRegressionOptions options;
  options.named = with("lagged_expansion", "T_base_degC");
  const TrainedRegression trained = trained_regression({&run, 1}, "z_um", options);
  ASSERT_TRUE(trained.named.with_um && trained.named.without_um);
  const bool helps = *trained.named.with_um <= *trained.named.without_um;
  EXPECT_EQ(trained.named.effects.size(), helps ? 1U : 0U);
  EXPECT_EQ(trained.regression.forecasts->rmse_um, std::min(*trained.named.with_um, *trained.named.without_um));
}

TEST(Named, what_stands_still_is_left_out) {
  Series run = made::run({.rows = 300}, "still");
  run.columns.insert(run.columns.begin(), Column{"T_cool_degC", Role::coolant, std::vector<double>(300, 20.0)});
  EffectRegressionOptions options;
  options.named = with("expansion", "T_cool_degC");
  EXPECT_TRUE(trained_regression({&run, 1}, "z_um", options).named.effects.empty());
}

TEST(Named, an_effect_without_a_column_is_refused) {
  const Series run = made::run({.rows = 300}, "refused");
  EffectRegressionOptions options;
  options.named = Model{};
  options.named->targets = {"z_um"};
  options.named->terms.push_back(term_of("linear_drift", {}));
  EXPECT_THROW(trained_regression({&run, 1}, "z_um", options), Error);
}

TEST(Start, a_short_run_of_a_like_machine_is_predicted_better) {
  const std::vector<Series> others = {made::run({.rows = 300}, "a"), made::run({.rows = 300}, "b"),
                                      made::run({.rows = 300}, "c")};
  const EffectRegression fleet = effect_regression(others, "z_um");
  const Series short_run = made::run({.rows = 100}, "new"), later = made::run({.rows = 300}, "later");
  EffectRegressionOptions options;
  options.start = &fleet;
  const TrainedRegression adapted = trained_regression({&short_run, 1}, "z_um", options);
  ASSERT_TRUE(adapted.start);
  EXPECT_GE(adapted.start->borrowed, 0.0);
  EXPECT_LE(adapted.start->borrowed, 1.0);
  if (adapted.start->used) {
    EXPECT_LE(*adapted.start->adapted_um, *adapted.start->alone_um);
    EXPECT_LT(rmse_um(adapted.regression, later), rmse_um(effect_regression({&short_run, 1}, "z_um"), later));
  }
  // What the others have seen is within what is trained.
  for (const ColumnRange& range : fleet.model.trained) {
    for (const ColumnRange& own : adapted.regression.model.trained) {
      if (own.column == range.column && adapted.start->used) {
        EXPECT_LE(own.low, range.low);
        EXPECT_GE(own.high, range.high);
      }
    }
  }
}

TEST(Start, a_machine_that_is_another_is_predicted_from_its_own_rows) {
  const std::vector<Series> others = {made::run({.rows = 240}, "a"), made::run({.rows = 240}, "b")};
  const EffectRegression fleet = effect_regression(others, "z_um");
  Series other = made::run({.rows = 240}, "other");
  for (double& value : other.columns.back().values) value *= -3.0;
  EffectRegressionOptions options;
  options.start = &fleet;
  const TrainedRegression adapted = trained_regression({&other, 1}, "z_um", options);
  const double alone_um = effect_regression({&other, 1}, "z_um").forecasts->rmse_um;
  EXPECT_LE(adapted.regression.forecasts->rmse_um, alone_um);
  EXPECT_EQ(*adapted.start->alone_um, alone_um);
}

TEST(Start, a_column_that_is_missing_or_has_gaps_is_named) {
  const Series run = made::run({.rows = 240}, "a");
  const EffectRegression fleet = effect_regression({&run, 1}, "z_um");
  EffectRegressionOptions options;
  options.start = &fleet;
  Series less = made::run({.rows = 120}, "less");
  const std::string missing = fleet.model.trained.front().column;
  std::erase_if(less.columns, [&](const Column& column) { return column.name == missing; });
  EXPECT_THROW(trained_regression({&less, 1}, "z_um", options), Error);
  Series gaps = made::run({.rows = 120}, "gaps");
  for (Column& column : gaps.columns) {
    if (column.name == missing) column.values[7] = std::nan("");
  }
  EXPECT_THROW(trained_regression({&gaps, 1}, "z_um", options), Error);
}

}  // namespace
}  // namespace ballbar
