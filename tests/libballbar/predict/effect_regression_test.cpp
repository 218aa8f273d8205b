// How well a known system is predicted, what the prediction is made of, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "ballbar/predict/train.hpp"
#include "made_runs.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

EffectRegression trained(std::span<const Series> runs, bool forecasts = true) {
  EffectRegressionOptions options;
  options.forecasts = forecasts;
  return effect_regression(runs, "z_um", options);
}

EffectRegression trained(const Series& series, bool forecasts = true) { return trained({&series, 1}, forecasts); }

// The noise alone would be 1; gains and shapes between those of the grids are allowed 0.3 of it in the median of five
// duty cycles, of whose readings 90 to 99 % are within the interval of 95 %.
TEST(effect_regression, a_linear_system_is_predicted_nearly_to_its_noise) {
  const EffectRegression regression = trained(made::run({.rows = 2000}, "linear_system"));
  std::size_t within = 0, count = 0;
  std::vector<double> rmse_um;
  for (const char* const seed : {"first", "second", "third", "fourth", "fifth"}) {
    const Series other = made::run({}, seed);
    const RegressionPrediction prediction = predict(regression, other);
    const std::vector<double>& z_um = find_column(other, "z_um")->values;
    double sum = 0.0;
    for (std::size_t i = 0; i < z_um.size(); ++i) {
      const double error = z_um[i] - prediction.predicted_um[i];
      sum += error * error;
      if (std::abs(error) <= prediction.half_width_um[i]) ++within;
    }
    count += z_um.size();
    rmse_um.push_back(std::sqrt(sum / static_cast<double>(z_um.size())));
  }
  std::sort(rmse_um.begin(), rmse_um.end());
  EXPECT_LT(rmse_um[2], 1.3 * 0.3);
  EXPECT_GT(rmse_um[2], 0.9 * 0.3);
  const double share = static_cast<double>(within) / static_cast<double>(count);
  EXPECT_GE(share, 0.90);
  EXPECT_LE(share, 0.99);
  EXPECT_EQ(regression.rows, 2000U);
  EXPECT_NEAR(regression.rmse_um, 0.3, 0.03);
  ASSERT_TRUE(regression.forecasts);
  EXPECT_EQ(regression.forecasts->count, 3U);
  EXPECT_LT(regression.forecasts->rmse_um, 0.2 * regression.forecasts->held_um);
  EXPECT_GE(regression.interval_scale, 1.0);
}

TEST(effect_regression, shares_of_drivers_add_up_to_the_range) {
  const EffectRegression regression = trained(made::run({}, "shares"), false);
  Series other = made::run({}, "shares of another");
  made::values_of(other, "T_front_degC")[5] = kGap;
  const RegressionPrediction prediction = predict(regression, other);
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0.0;
  for (std::size_t i = 0; i < other.time_s.size(); ++i) {
    if (i == 5) continue;
    low = std::min(low, prediction.predicted_um[i]);
    high = std::max(high, prediction.predicted_um[i]);
  }
  std::vector<std::string> names;
  for (std::size_t d = 0; d < prediction.drivers.size(); ++d) {
    const DriverShare& driver = prediction.drivers[d];
    sum += driver.share_um;
    names.push_back(driver.column);
    EXPECT_EQ(driver.role, find_column(other, driver.column)->role);
    if (d > 0) {
      EXPECT_LE(std::abs(driver.share_um), std::abs(prediction.drivers[d - 1].share_um));
    }
  }
  EXPECT_NEAR(sum, high - low, 1e-9);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"T_base_degC", "T_front_degC", "speed_rpm"}));
}

// What moves alone drives alone.
TEST(effect_regression, what_stands_still_drives_nothing) {
  const EffectRegression regression = trained(made::run({}, "shares"), false);
  Series other = made::run({}, "shares of another");
  for (const char* const name : {"T_base_degC", "speed_rpm"}) {
    std::vector<double>& values = made::values_of(other, name);
    std::fill(values.begin(), values.end(), values.front());
  }
  std::fill(made::values_of(other, "speed_rpm").begin(), made::values_of(other, "speed_rpm").end(), 0.0);
  const RegressionPrediction prediction = predict(regression, other);
  const auto [low, high] = std::minmax_element(prediction.predicted_um.begin(), prediction.predicted_um.end());
  EXPECT_EQ(prediction.drivers.front().column, "T_front_degC");
  EXPECT_NEAR(prediction.drivers.front().share_um, *high - *low, 1e-6 * (*high - *low));
}

TEST(effect_regression, rows_outside_the_trained_range_are_told) {
  const Series series = made::run({}, "outside");
  const EffectRegression regression = trained(series, false);
  EXPECT_TRUE(predict(regression, series).outside.empty());
  const std::vector<double>& base = find_column(series, "T_base_degC")->values;
  const auto [low, high] = std::minmax_element(base.begin(), base.end());
  const double span = *high - *low;
  Series other = series;
  std::vector<double>& values = made::values_of(other, "T_base_degC");
  values[100] = *high + 0.09 * span;  // by less than a tenth: taken for inside
  values[200] = *high + 0.11 * span;
  values[300] = *low - 0.5 * span;
  values[301] = *low - 0.4 * span;
  const RegressionPrediction prediction = predict(regression, other);
  ASSERT_EQ(prediction.outside.size(), 1U);
  const OutsideRange& outside = prediction.outside.front();
  EXPECT_EQ(outside.what, "T_base_degC");
  EXPECT_EQ(outside.rows, 3U);
  EXPECT_EQ(outside.time_s, 200.0 * 30.0);
  EXPECT_EQ(outside.value, values[300]);
  EXPECT_EQ(outside.low, *low);
  EXPECT_EQ(outside.high, *high);
  LivePrediction live(regression);
  std::vector<double> row;
  for (const std::string& name : live.columns()) row.push_back(find_column(other, name)->values[100]);
  EXPECT_FALSE(live.next(0.0, row).outside);
  for (std::size_t c = 0; c < row.size(); ++c) row[c] = find_column(other, live.columns()[c])->values[200];
  EXPECT_TRUE(live.next(30.0, row).outside);
}

TEST(effect_regression, columns_with_gaps_or_that_stand_still_are_left_out) {
  std::vector<Series> runs{made::run({}, "left out"), made::run({}, "left out too")};
  for (Series& run : runs) {
    std::vector<double> other = find_column(run, "T_base_degC")->values;
    run.columns.push_back({"T_gap_degC", Role::structure, other});
    run.columns.push_back({"T_still_degC", Role::structure, std::vector<double>(run.time_s.size(), 20.0)});
    run.columns.push_back({"T_moved_degC", Role::structure, std::vector<double>(run.time_s.size(), 20.0)});
  }
  made::values_of(runs[1], "T_gap_degC")[7] = kGap;
  made::values_of(runs[1], "T_moved_degC").assign(runs[1].time_s.size(), 22.0);  // stands still within each
  const EffectRegression regression = trained(runs, false);
  EXPECT_EQ(regression.left_out, (std::vector<std::string>{"T_gap_degC", "T_still_degC"}));
  for (const Term& term : regression.model.terms) {
    for (const std::string& column : term.columns) {
      EXPECT_TRUE(column != "T_gap_degC" && column != "T_still_degC" && column != "z_um") << column;
    }
  }
}

TEST(effect_regression, what_cannot_be_trained_on_is_refused) {
  const Series series = made::run({.rows = 100}, "refused");
  made::expect_error("expected a record to train on, found none.", [] { trained(std::span<const Series>()); });
  made::expect_error(
      "target: expected a column of the data for the target, one of speed_rpm, T_front_degC, T_base_degC, z_um, found "
      "\"zz_um\"; the nearest is z_um.",
      [&] {
        effect_regression({&series, 1}, "zz_um");
      });
  std::vector<Series> runs{series, series};
  std::erase_if(runs[1].columns, [](const Column& column) { return column.name == "T_base_degC"; });
  made::expect_error("expected T_base_degC in every run, found one without.", [&] { trained(runs); });
  Series few = series;
  std::vector<double>& z_um = made::values_of(few, "z_um");
  std::fill(z_um.begin() + 39, z_um.end(), kGap);
  made::expect_error("z_um: expected at least 40 values to train on, found 39.", [&] { trained(few); });
  z_um[50] = 1.0;
  EXPECT_EQ(trained(few).rows, 40U);
  Series bare = series;
  std::erase_if(bare.columns, [](const Column& column) { return column.name != "z_um"; });
  made::expect_error("expected a column of a temperature, a speed or a load that moves, found none.",
                     [&] { trained(bare); });
  Series without_base = made::run({}, "without base");
  std::erase_if(without_base.columns, [](const Column& column) { return column.name == "T_base_degC"; });
  made::expect_error("expected a column T_base_degC, found none; the nearest is T_front_degC.",
                     [&] { predict(trained(series, false), without_base); });
}

}  // namespace
}  // namespace ballbar
