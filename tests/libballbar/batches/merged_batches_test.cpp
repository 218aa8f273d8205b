#include "ballbar/batches/merged_batches.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"

namespace ballbar {
namespace {

// A body that follows its sensor with 900 s, 3 um/K; each batch begins at a temperature of its own.
Series batch(double from_degC, double step_K) {
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
  const Series both[] = {batch(12.0, 5.0), batch(31.0, -2.0)};
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
  Series series = batch(20.0, 1.0);
  series.columns.erase(series.columns.begin());
  const Series both[] = {batch(12.0, 5.0), series};
  try {
    joined_batches(both, model());
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "expected a column T_degC, found none; the nearest is z_um.");
  }
}

}  // namespace
}  // namespace ballbar
