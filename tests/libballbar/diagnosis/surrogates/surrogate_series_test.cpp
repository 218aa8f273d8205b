// Surrogates of effects on a drift.
#include "diagnosis/surrogates/surrogate_series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "diagnosis/made_drift.hpp"
#include "diagnosis/surrogates/phase_randomised.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

struct Tried {
  BestSurrogate best;
  double own = 0.0;  // fall of chi^2 by the effect itself
};

// The residual: `scale` times the room, of length 1 beside a constant, and white noise of 1 um.
Tried tried(double scale, std::uint64_t seed) {
  const Series data = made::drift({0.0, 1, 200});
  const std::vector<double>& room = data.columns[1].values;
  Eigen::VectorXd added = Eigen::VectorXd::Map(room.data(), 200);
  added.array() -= added.mean();
  added.normalize();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd residual_um = scale * added;
  for (double& value : residual_um) value += normal(random);
  Background background;
  background.row.resize(data.time_s.size());
  std::iota(background.row.begin(), background.row.end(), std::size_t{0});
  background.whiten = [](const Eigen::MatrixXd& columns) { return columns; };
  const Eigen::MatrixXd basis = orthonormal(Eigen::MatrixXd::Ones(200, 1));
  background.white = background.plain = {basis, orthogonal_part(residual_um, basis)};
  const SurrogateSource source{{find_effect("expansion", Level::series), {"T_room_degC"}}, {{0.0}}, {}};
  return {best_surrogate(source, data, background, 200, 1), std::pow(residual_um.dot(added), 2)};
}

TEST(SurrogateSeries, of_an_effect_that_is_there_do_worse) {
  const Tried found = tried(20.0, 5);
  EXPECT_LT(found.best.gain, found.own);
  EXPECT_GT(found.best.gain, 0.02 * found.own);  // a smooth curve buys something of any other
  EXPECT_GT(found.best.fall, 0.0);
  EXPECT_LT(found.best.fall, 1.0);
}

TEST(SurrogateSeries, of_an_effect_that_is_not_there_do_better) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Tried found = tried(0.0, seed);
    EXPECT_GT(found.best.gain, found.own) << seed;
  }
}

TEST(SurrogateSeries, are_the_same_every_time) { EXPECT_EQ(tried(5.0, 2).best.gain, tried(5.0, 2).best.gain); }

// Other phases leave the amplitudes of the waves: about the line through its ends the sum of squares is the same.
void expect_the_same_square(std::size_t count) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  double memory = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(3.0 + 0.1 * static_cast<double>(i) + (memory = 0.9 * memory + normal(random)));
  const Spectrum spectrum = spectrum_of(values);
  const std::vector<double> turned = phase_randomised(spectrum, random_phases(count, random));
  ASSERT_EQ(turned.size(), values.size());
  const auto square = [&](const std::vector<double>& curve) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      sum += std::pow(
          curve[i] - spectrum.first - spectrum.rise * static_cast<double>(i) / static_cast<double>(count - 1), 2);
    return sum;
  };
  const double mean_free = square(values);
  EXPECT_GT(mean_free, 0.0);
  EXPECT_NE(turned, values);
  EXPECT_NEAR(square(turned), mean_free, 1e-9 * mean_free);
}

TEST(PhaseRandomised, has_the_same_square) { expect_the_same_square(128); }

TEST(PhaseRandomised, has_a_phase_for_each_wave_of_an_odd_count) {
  std::mt19937_64 random(1);
  EXPECT_EQ(random_phases(5, random).size(), 3U);  // waves 0, 1 and 2; 3 and 4 are the conjugates
  expect_the_same_square(129);
}

}  // namespace
}  // namespace ballbar
