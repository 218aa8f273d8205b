#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "ballbar/fit/fit.hpp"

namespace ballbar {
namespace {

// Three hours of warming by 20 K, three of cooling by 15 K. z grows by `heating` for each K, and shrinks by `cooling`.
Series warmed(double heating, double cooling, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.3);
  Series series;
  Column temperature{"T_degC", Role::structure, {}}, z{"z_um", Role::measured, {}};
  double grown_um = 0.0;
  for (int minute = 0; minute <= 360; ++minute) {
    series.time_s.push_back(60.0 * minute);
    const double now = minute <= 180 ? 20.0 + minute / 9.0 : 40.0 - (minute - 180) / 12.0;
    if (minute > 0) grown_um += (minute <= 180 ? heating : cooling) * (now - temperature.values.back());
    temperature.values.push_back(now);
    z.values.push_back(grown_um + noise(random));
  }
  series.columns = {temperature, z};
  return series;
}

Coefficient coefficient_of(const Series& series) {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_degC"})};
  const std::vector<Coefficient> all = coefficients_of(model, fit(model, series), series);
  EXPECT_EQ(all.size(), 1U);
  return all.front();
}

TEST(Coefficient, has_its_span_and_is_the_same_in_heating_and_cooling) {
  int within = 0;
  constexpr int kSeeds = 60;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Coefficient one = coefficient_of(warmed(2.0, 2.0, seed));
    EXPECT_NEAR(one.span_K, 20.0, 1e-9);
    EXPECT_NEAR(one.size_um, 40.0, 1.0);
    EXPECT_NEAR(one.value.value_um, 2.0, 5.0 * one.value.sigma_um);
    ASSERT_TRUE(one.rising && one.falling);
    within += std::abs(one.rising->value_um - 2.0) <= 2.0 * one.rising->sigma_um ? 1 : 0;
    within += std::abs(one.falling->value_um - 2.0) <= 2.0 * one.falling->sigma_um ? 1 : 0;
    EXPECT_TRUE(is_usual(one));
  }
  EXPECT_GE(within, 106);  // of 120: 95 %
}

TEST(Coefficient, of_heating_and_cooling_differ_where_the_body_does) {
  const Coefficient one = coefficient_of(warmed(2.0, 1.0, 7));
  ASSERT_TRUE(one.rising && one.falling);
  EXPECT_NEAR(one.rising->value_um, 2.0, 0.1);
  EXPECT_NEAR(one.falling->value_um, 1.0, 0.1);
}

TEST(Coefficient, one_direction_alone_is_not_apart) {
  Series series = warmed(2.0, 2.0, 3);
  series.time_s.resize(181);
  for (Column& column : series.columns) column.values.resize(181);
  EXPECT_FALSE(coefficient_of(series).rising);
}

TEST(Coefficient, of_four_metres_of_steel_is_unusual) { EXPECT_FALSE(is_usual(coefficient_of(warmed(46.0, 46.0, 1)))); }

}  // namespace
}  // namespace ballbar
