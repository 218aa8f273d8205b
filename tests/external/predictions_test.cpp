// Predictions of an effect regression on measured records: how large their errors are.
#include <cmath>

#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

// The last eighth of 28 h, at a speed above all of training: 3.7 h ahead.
TEST(Predictions, end_of_the_spindles_record) {
  REQUIRE_EXTERNAL_DATA(folder);
  const std::filesystem::path file = folder / "spindle-46h" / "measured.csv";
  const Series series = read_series(read_bytes(file, kLargestTable), "measured.csv");
  constexpr std::size_t kTrained = 5791, kRows = 6669;  // of 11 116: the first 60 %
  const Series before = rows_of(series, {0, kTrained}), after = rows_of(series, {kTrained, kRows});
  EffectRegressionOptions options;
  options.forecasts = false;
  const EffectRegression regression = effect_regression({&before, 1}, "ch1_um", options);
  const RegressionPrediction prediction = predict(regression, after);
  EXPECT_TRUE(prediction.goes_on);
  const std::vector<double>& measured_um = find_column(after, "ch1_um")->values;
  double sum = 0.0;
  for (std::size_t i = 0; i < measured_um.size(); ++i) sum += std::abs(measured_um[i] - prediction.predicted_um[i]);
  const double error_um = sum / static_cast<double>(measured_um.size());
  EXPECT_LT(error_um, 1.0);
  EXPECT_GT(error_um, 0.2);
}

// From three changes of speed, up to 8 h ahead, all five channels: mean absolute errors, weighed by rows.
TEST(Predictions, forecasts_of_the_spindles_five_channels) {
  REQUIRE_EXTERNAL_DATA(folder);
  const std::filesystem::path file = folder / "spindle-46h" / "measured.csv";
  Series series = read_series(read_bytes(file, kLargestTable), "measured.csv");
  for (Column& column : series.columns) {  // as the sample run states them
    if (column.name == "T16_degC") column.role = Role::ambient;
    if (column.name == "T4_degC") column.role = Role::coolant;
  }
  const std::pair<const char*, double> expected_um[] = {
      {"ch1_um", 1.0}, {"ch2_um", 1.2}, {"ch3_um", 2.1}, {"ch4_um", 1.8}, {"ch5_um", 1.8}};
  for (const auto& [target, error_um] : expected_um) {
    double sum = 0.0, rows = 0.0;
    for (const std::size_t origin : {3871U, 4831U, 5791U}) {
      const std::size_t end = std::min<std::size_t>(6669, origin + 1920);
      const Series before = rows_of(series, {0, origin}), after = rows_of(series, {origin, end});
      EffectRegressionOptions options;
      options.forecasts = false;
      const RegressionPrediction prediction = predict(effect_regression({&before, 1}, target, options), after);
      const std::vector<double>& measured_um = find_column(after, target)->values;
      for (std::size_t i = 0; i < measured_um.size(); ++i) sum += std::abs(measured_um[i] - prediction.predicted_um[i]);
      rows += static_cast<double>(measured_um.size());
    }
    EXPECT_NEAR(sum / rows, error_um, 0.05) << target;  // as printed in the README of the sample run
  }
}

// 29 batches without the sensor that broke, each left out in turn. A regression on temperatures alone (principal
// components) leaves 5.89 um of z and 14.76 um of x.
TEST(Predictions, batches_of_a_lathe_left_out) {
  REQUIRE_EXTERNAL_DATA(folder);
  std::vector<Series> runs;
  for (const ListedRun& run : open_runs(folder / "lathe-chamber" / "runs.csv").runs) {
    runs.push_back(read_series(read_bytes(run.file, kLargestTable), run.name));
    std::erase_if(runs.back().columns, [](const Column& column) { return column.name == "PT10_degC"; });
  }
  ASSERT_EQ(runs.size(), 29U);
  const auto rmse_um = [&](const char* target) {
    const EffectRegression regression = effect_regression(runs, target);
    EXPECT_EQ(regression.forecasts->count, 29U);
    EXPECT_GT(regression.forecasts->held_um, 1.5 * regression.forecasts->rmse_um);  // each run counts alike
    return regression.forecasts->rmse_um;
  };
  const double z_um = rmse_um("z_um"), x_um = rmse_um("x_um");
  EXPECT_LE(z_um, 3.9);
  EXPECT_GT(z_um, 3.0);
  EXPECT_LE(x_um, 10.6);
  EXPECT_GT(x_um, 9.0);
}

}  // namespace
}  // namespace ballbar
