// How much each batch counts for a job.
#include "ballbar/internal/predict/batch_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "ballbar/error.hpp"
#include "made_batches.hpp"

namespace ballbar {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// One sensor, the room's: T - 1, T, T + 1. The target is 2 um/K of it and c (1, -2, 1), which neither a constant nor
// the temperature draws.
Batch three_rows(double room_degC, double c_um) {
  const Series series{{0.0, 10.0, 20.0},
                      {{"T_room_degC", Role::structure, {room_degC - 1.0, room_degC, room_degC + 1.0}},
                       {"z_um",
                        Role::measured,
                        {2.0 * room_degC - 2.0 + c_um, 2.0 * room_degC - 2.0 * c_um, 2.0 * room_degC + 2.0 + c_um}}},
                      std::nullopt};
  return batch_of("", series, batch_columns(series, InputKind::temperature, "z_um", {}));
}

BatchStart room_at(double degC) { return {degC, degC, degC, 0.0, std::numeric_limits<double>::quiet_NaN()}; }

// First rows of 19, 21 and 23 degC where the rooms' means are 20, 22, 24: standard deviation 2 K of the first feature
// and 2 K of the second, the others alike. A job that begins at 20 degC is 0.5, 0.5 and 1.5 of it away in each:
// d = sqrt(2) times that; w = exp(-(d^2 - least d^2) / (2 h^2)).
TEST(batch_weights, distances_and_weights_by_hand) {
  const std::vector<Batch> batches{three_rows(20.0, 1.0), three_rows(22.0, 1.0), three_rows(24.0, 1.0)};
  const BatchWeights found = batch_weights(batches, room_at(20.0), RegressionMethod::pcr);
  const std::vector<double> away{0.5, 0.5, 1.5};
  ASSERT_EQ(found.weight.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.distance[k], std::sqrt(2.0) * away[k], 1e-12);
    const double d2 = 2.0 * (away[k] * away[k] - 0.25);
    const double h2 = found.bandwidth * found.bandwidth;
    EXPECT_NEAR(found.weight[k], std::isfinite(h2) ? std::exp(-d2 / (2.0 * h2)) : 1.0, 1e-12);
  }
}

TEST(batch_weights, messages) {
  const std::vector<Batch> batches{three_rows(21.0, 1.0), three_rows(19.0, 2.0)};
  for (std::size_t n = 0; n < 3; ++n) {
    try {
      (void)batch_weights(std::span(batches.data(), n), room_at(20.0), RegressionMethod::pcr);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), fmt::format("expected at least 3 batches to choose from, found {}.", n));
    }
  }
}

struct World {
  std::vector<Batch> batches;
  BatchStart job;
  Moments measured;
};

// 40 batches of rooms from 10 to 30 degC and a job; um/K of the fast rise as `gain` says of the room.
World world(const std::string& seed, double job_degC, const made::Batches& plan,
            const std::function<double(double)>& gain) {
  std::mt19937_64 random(made::seed_of(seed));
  std::uniform_real_distribution<double> uniform;
  std::vector<Series> all;
  for (std::size_t k = 0; k < 40; ++k) {
    const double room = 10.0 + 20.0 * uniform(random), heat = 15.0 + 20.0 * uniform(random);
    all.push_back(made::warm_up(plan, room, heat, gain(room), random));
  }
  const BatchColumns columns = made::columns_of(all);
  const Series job = made::warm_up(plan, job_degC, 25.0, gain(job_degC), random);
  const Batch of_job = batch_of("job", job, columns);
  return {made::batches_of(all, columns), of_job.start, of_job.moments};
}

// 0.4 um/K at 10 degC, 1.2 at 30 degC: one slope for all batches is wrong at either end by some 0.3 um/K times 25 K.
double changing(double room_degC) { return 0.04 * room_degC; }

TEST(batch_weights, where_the_slope_depends_on_the_room_near_batches_predict_better) {
  for (const double job_degC : {12.0, 28.0}) {
    const World made = world("near_batches", job_degC, {}, changing);
    const BatchWeights found = batch_weights(made.batches, made.job, RegressionMethod::pcr);
    const auto predicted_um = [&](const std::vector<double>& weight, const RegressionSettings& settings) {
      return rmse_um(made.measured, regress(merged(made.batches, weight), settings));
    };
    const double all_um = predicted_um({}, best_settings(made.batches, RegressionMethod::pcr));
    EXPECT_LT(predicted_um(found.weight, found.settings), 0.7 * all_um) << job_degC;
    EXPECT_LT(found.bandwidth, kInfinite) << job_degC;
  }
}

// Rooms 1 K apart, the target by turns 1 um above and below the law: a batch left out is the opposite of those beside
// it, the less so the more batches count.
TEST(batch_weights, of_an_infinite_bandwidth_are_all_alike) {
  std::vector<Batch> batches;
  for (std::size_t k = 0; k < 40; ++k) {
    batches.push_back(three_rows(20.0 + static_cast<double>(k), 1.0));
    batches.back().moments.mean[1] += k % 2 == 0 ? 1.0 : -1.0;
  }
  const BatchWeights found = batch_weights(batches, room_at(40.0), RegressionMethod::pcr);
  ASSERT_EQ(found.bandwidth, kInfinite);
  EXPECT_EQ(found.weight, std::vector<double>(40, 1.0));
}

}  // namespace
}  // namespace ballbar
