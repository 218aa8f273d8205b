#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/predict/train.hpp"

namespace ballbar {
namespace {

// (3^2 + 4^2) / 2 = 12.5
TEST(held_out_errors, of_each_batch) {
  const double um[] = {3.0, 4.0};
  const HeldOutErrors errors = held_out_errors(um);
  EXPECT_DOUBLE_EQ(errors.rms_um, std::sqrt(12.5));
  EXPECT_EQ(errors.worst_um, 4.0);
  EXPECT_EQ(errors.worst, 1u);
}

// Rises of 0, step, 2 step from a temperature of its own.
Series batch(double from_degC, double step_K, double gain_um_per_K) {
  Series series;
  Column sensor{"T_degC", Role::structure, {}}, target{"z_um", Role::measured, {}};
  for (int i = 0; i < 3; ++i) {
    series.time_s.push_back(60.0 * i);
    sensor.values.push_back(from_degC + step_K * i);
    target.values.push_back(gain_um_per_K * step_K * i);
  }
  series.columns = {sensor, target};
  return series;
}

// gain (T - T0) with 1 um/K over 0, 2, 4 K and with 3 um/K over 0, 1, 2 K. Each predicted by the other's gain is off by
// 2 um/K: mean squares (0 + 16 + 64) / 3 = 80 / 3 and (0 + 4 + 16) / 3 = 20 / 3, so 50 / 3 over both.
TEST(held_out_errors, of_a_model_of_effects) {
  Model model;
  model.targets = {"z_um"};
  model.constant_um = 0.0;
  model.terms = {term_of("expansion", {"T_degC"})};
  const Series batches[] = {batch(15.0, 2.0, 1.0), batch(25.0, 1.0, 3.0)};
  FitOptions options;
  options.white = true;
  std::vector<std::size_t> left_out;
  const HeldOutErrors errors = held_out_errors(model, batches, options, [&](std::size_t k) { left_out.push_back(k); });
  EXPECT_NEAR(errors.rms_um, std::sqrt(50.0 / 3.0), 1e-6);
  EXPECT_NEAR(errors.worst_um, std::sqrt(80.0 / 3.0), 1e-6);
  EXPECT_EQ(errors.worst, 0u);
  EXPECT_EQ(left_out, (std::vector<std::size_t>{0, 1}));
}

// Targets 3, 4 um and 0, 1 um: mean squares 12.5 and 0.5.
TEST(held_out_errors, without_a_model) {
  const auto of_targets = [](double mean_um) {
    Batch batch;
    batch.moments.weight = 2.0;
    batch.moments.mean = Eigen::Vector2d(20.0, mean_um);
    batch.moments.scatter = Eigen::Vector2d(1.0, 0.5).asDiagonal();
    return batch;
  };
  const Batch batches[] = {of_targets(3.5), of_targets(0.5)};
  EXPECT_NEAR(rms_without_model_um(batches), std::sqrt(6.5), 1e-12);
}

// A body that follows its sensor with 900 s, 3 um/K; each batch begins at a temperature of its own.
Series lagging_batch(double from_degC, double step_K) {
  Series series;
  Column sensor{"T_degC", Role::structure, {}}, target{"z_um", Role::measured, {}};
  for (int i = 0; i < 60; ++i) {
    const double t = 60.0 * i;
    series.time_s.push_back(5000.0 + t);
    sensor.values.push_back(from_degC + (t > 0.0 ? step_K : 0.0));
    // The sensor rises along a straight line in the first minute: the lag of a ramp.
    const double at_60 = step_K * (1.0 - 900.0 / 60.0 * (1.0 - std::exp(-60.0 / 900.0)));
    target.values.push_back(i == 0 ? 0.0 : 3.0 * (step_K - (step_K - at_60) * std::exp(-(t - 60.0) / 900.0)));
  }
  series.columns = {sensor, target};
  return series;
}

Model model() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("lagged_expansion", {"T_degC"})};
  return model;
}

TEST(JoinedBatches, one_fit_to_batches_of_two_seasons) {
  const Series both[] = {lagging_batch(12.0, 5.0), lagging_batch(31.0, -2.0)};
  const Series joined = joined_batches(both, model());
  EXPECT_EQ(joined.time_s.size(), 122U);  // and two rows in which the machine stands
  EXPECT_DOUBLE_EQ(joined.time_s.front(), 0.0);
  EXPECT_GT(joined.time_s[62] - joined.time_s[60], 800000.0);
  EXPECT_TRUE(std::isnan(find_column(joined, "z_um")->values[60]));
  EXPECT_DOUBLE_EQ(find_column(joined, "T_degC")->values[61], 0.0);
  FitOptions options;
  options.white = true;
  const Fit found = fit(model(), joined, 0, options);
  EXPECT_NEAR(found.parameters[1].value, 3.0, 1e-3);  // what the start's grid of time constants leaves
  EXPECT_NEAR(found.parameters[2].value, 900.0, 1.0);
  EXPECT_LT(found.rmse_um, 1e-3);
}

TEST(JoinedBatches, a_batch_without_the_column_is_told) {
  Series series = lagging_batch(20.0, 1.0);
  series.columns.erase(series.columns.begin());
  const Series both[] = {lagging_batch(12.0, 5.0), series};
  try {
    joined_batches(both, model());
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "expected a column T_degC, found none; the nearest is z_um.");
  }
}

}  // namespace
}  // namespace ballbar
