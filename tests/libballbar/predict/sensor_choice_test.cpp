// Sensors of a known system: which are found, what each buys, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "ballbar/predict/train.hpp"
#include "made_runs.hpp"

namespace ballbar {
namespace {

// Six sensors, each a random walk that is held near 20 degC with a time constant of its own, but for twin_degC, which
// is front_degC and 0.005 K of noise;
//   z = 1.5 LP_900s[front] - 2 LP_3000s[base] + 0.1 um of noise
Series six_sensors(std::size_t rows, std::string_view seed) {
  constexpr double kInterval_s = 60.0;
  std::seed_seq words(seed.begin(), seed.end());
  std::mt19937_64 random(words);
  std::normal_distribution<double> normal;
  Series series;
  series.columns = {{"door_degC"}, {"front_degC"}, {"twin_degC"}, {"base_degC"}, {"oil_degC"}, {"air_degC"}};
  Column z{"z_um", Role::measured, {}};
  const std::array<double, 6> forgets_s{7000.0, 5000.0, 0.0, 6000.0, 4000.0, 8000.0};
  std::array<double, 6> rise_K{};
  made::Lag of_front(900.0, kInterval_s), of_base(3000.0, kInterval_s);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t s = 0; s < rise_K.size(); ++s) {
      if (forgets_s[s] > 0.0 && i > 0) {
        rise_K[s] += 0.3 * normal(random) - kInterval_s / forgets_s[s] * rise_K[s];
      }
    }
    rise_K[2] = rise_K[1] + 0.005 * normal(random);
    series.time_s.push_back(kInterval_s * static_cast<double>(i));
    for (std::size_t s = 0; s < rise_K.size(); ++s) series.columns[s].values.push_back(20.0 + rise_K[s]);
    z.values.push_back(1.5 * of_front.next(rise_K[1]) - 2.0 * of_base.next(rise_K[3]) + 0.1 * normal(random));
  }
  series.columns.push_back(std::move(z));
  return series;
}

bool is_front(const std::string& name) { return name == "front_degC" || name == "twin_degC"; }

// Front or its twin, and base: with both the error is that of the noise, whose mean absolute value is 0.08 um.
void expect_two_found(const SensorChoice& choice, std::size_t folds) {
  EXPECT_EQ(choice.folds, folds);
  EXPECT_EQ(choice.rated, 6U);
  ASSERT_EQ(choice.sets.size(), 3U);
  EXPECT_TRUE(choice.sets[0].sensors.empty());
  std::vector<std::string> two = choice.sets[2].sensors;
  ASSERT_EQ(two.size(), 2U);
  if (is_front(two[1])) std::swap(two[0], two[1]);
  EXPECT_TRUE(is_front(two[0])) << two[0];
  EXPECT_EQ(two[1], "base_degC");
  EXPECT_EQ(choice.enough, 2U);
  EXPECT_GT(choice.sets[0].forecasts.error_um, 1.0);
  EXPECT_GT(choice.sets[1].forecasts.error_um, 0.5);
  EXPECT_LT(choice.sets[2].forecasts.error_um, 0.2);
  EXPECT_GT(choice.sets[2].buys_um, 5.0 * choice.sets[2].forecasts.error_um);
  EXPECT_NEAR(choice.sets[2].buys_um, choice.sets[1].forecasts.error_um - choice.sets[2].forecasts.error_um, 1e-12);
  EXPECT_GT(choice.sets[2].sigma_buys_um, 0.0);
  ASSERT_EQ(choice.chosen.size(), 2U);
  EXPECT_GE(choice.chosen[0].without_um, choice.chosen[1].without_um);
  for (const ChosenSensor& one : choice.chosen) {
    EXPECT_TRUE(one.needed);
    EXPECT_GT(one.without_um, 0.5);
    if (is_front(one.sensor)) {
      const std::string twin = one.sensor == "front_degC" ? "twin_degC" : "front_degC";
      EXPECT_EQ(one.substitutes, std::vector<std::string>{twin});
    } else {
      EXPECT_TRUE(one.substitutes.empty());
      EXPECT_EQ(one.folds, folds);
    }
  }
}

TEST(sensor_choice, the_two_that_matter_are_found_in_one_record) {
  const Series series = six_sensors(900, "six sensors");
  const SensorChoice choice = sensor_choice({&series, 1}, "z_um", 2);
  EXPECT_TRUE(choice.forecasts_ahead);
  expect_two_found(choice, 3);
  EXPECT_FALSE(choice.left_out);
  EXPECT_TRUE(choice.kept.empty());
}

TEST(sensor_choice, the_two_that_matter_are_found_in_runs) {
  std::vector<Series> runs;
  for (const char* const seed : {"1", "2", "3", "4", "5", "6"}) runs.push_back(six_sensors(250, seed));
  const SensorChoice choice = sensor_choice(runs, "z_um", 2);
  EXPECT_FALSE(choice.forecasts_ahead);
  expect_two_found(choice, 6);
  ASSERT_TRUE(choice.left_out);
  EXPECT_GE(choice.left_out->worst_um, choice.left_out->rms_um);
}

// All sensors are what trained_regression has; a sensor more than needed is not needed.
TEST(sensor_choice, the_error_of_all_is_that_of_the_training) {
  Series series = six_sensors(500, "all");
  std::erase_if(series.columns, [](const Column& one) { return one.name == "oil_degC" || one.name == "air_degC"; });
  const SensorChoice choice = sensor_choice({&series, 1}, "z_um", 4);
  const EffectRegression regression = effect_regression({&series, 1}, "z_um");
  ASSERT_TRUE(regression.forecasts);
  EXPECT_EQ(choice.all.forecasts.error_um, regression.forecasts->error_um);
  EXPECT_EQ(choice.all.forecasts.rmse_um, regression.forecasts->rmse_um);
  EXPECT_EQ(choice.sets[4].forecasts.error_um, regression.forecasts->error_um);
  EXPECT_EQ(choice.enough, 2U);
  for (const ChosenSensor& one : choice.chosen) {
    EXPECT_EQ(one.folds, 3U);
    EXPECT_EQ(one.needed, one.sensor == "base_degC") << one.sensor;
    EXPECT_TRUE(one.substitutes.empty());
  }
}

// What is no temperature is kept: it alone predicts what it drives.
TEST(sensor_choice, a_speed_is_kept_and_not_counted) {
  const Series series = made::run({.rows = 900}, "speed is kept");
  const SensorChoice choice = sensor_choice({&series, 1}, "z_um", 1);
  EXPECT_EQ(choice.kept, std::vector<std::string>{"speed_rpm"});
  EXPECT_EQ(choice.rated, 2U);
  EXPECT_LT(choice.sets[0].forecasts.rmse_um, 0.8 * choice.sets[0].forecasts.held_um);
}

TEST(sensor_choice, what_cannot_be_chosen_is_refused) {
  Series series = six_sensors(100, "refused");
  const std::string upto = "expected a number of sensors from 1 to 6, the temperatures that move and have no gaps, ";
  made::expect_error(upto + "found 7.", [&] { sensor_choice({&series, 1}, "z_um", 7); });
  made::expect_error(upto + "found 0.", [&] { sensor_choice({&series, 1}, "z_um", 0); });
  made::expect_error("expected a record to train on, found none.", [] { sensor_choice({}, "z_um", 1); });
  const Series few = six_sensors(50, "refused");
  made::expect_error("expected enough rows of z_um to test forecasts by which sensors are chosen, found 50.", [&] {
    sensor_choice({&few, 1}, "z_um", 1);
  });
  series = made::run({.rows = 900}, "speed is kept");
  std::erase_if(series.columns, [](const Column& one) { return unit_of(one.name) == "degC"; });
  made::expect_error(
      "expected temperatures (_degC or _K) that move and have no gaps to choose sensors from, found none.", [&] {
        sensor_choice({&series, 1}, "z_um", 1);
      });
}

}  // namespace
}  // namespace ballbar
