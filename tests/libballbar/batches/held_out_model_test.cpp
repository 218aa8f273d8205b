#include "ballbar/batches/held_out_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace ballbar
