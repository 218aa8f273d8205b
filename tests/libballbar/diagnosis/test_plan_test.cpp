#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/error.hpp"
#include "diagnosis/next_test/distinct_columns.hpp"
#include "diagnosis/next_test/menu.hpp"
#include "diagnosis/next_test/planned_inputs.hpp"
#include "effects/low_pass.hpp"

namespace ballbar {
namespace {

// One speed for hours: a housing warms by 8 K with 40 min, the room wanders; z follows the housing and the speed.
Series one_speed(bool with_twin, double noise_um = 0.3) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise;
  Series data;
  std::vector<double> speed, room, housing, z, heat;
  for (int i = 0; i < 300; ++i) {
    data.time_s.push_back(60.0 * i);
    speed.push_back(i < 20 ? 0.0 : 6000.0);
    heat.push_back(i < 20 ? 0.0 : 8.0);
    room.push_back(std::round(10.0 * (20.0 + 0.8 * std::sin(i / 47.0))) / 10.0);
  }
  std::vector<double> warm(heat.size());
  low_pass(
      data.time_s, [&](std::size_t i) { return heat[i]; }, 2400.0, warm.data());
  for (std::size_t i = 0; i < warm.size(); ++i) {
    housing.push_back(std::round(10.0 * (20.0 + warm[i] + 0.02 * noise(random))) / 10.0);
    z.push_back(1.5 * warm[i] + noise_um * noise(random));
  }
  data.columns = {{"speed_rpm", Role::speed, speed},
                  {"T_room_degC", Role::ambient, room},
                  {"T_housing_degC", Role::housing, housing},
                  {"z_um", Role::measured, z}};
  if (with_twin) data.columns.push_back({"T_twin_degC", Role::structure, housing});
  return data;
}

Model constant() {
  Model model;
  model.targets = {"z_um"};
  return model;
}

TEST(test_plan, every_test_of_the_menu_is_as_long_as_it_says_and_not_too_fast) {
  const auto moves_the_room = [](const ExpectedTest& item) {
    return std::any_of(item.schedule.dwells.begin(), item.schedule.dwells.end(),
                       [](const Dwell& dwell) { return dwell.room_K > 0.0; });
  };
  const Series data = one_speed(false);
  const std::vector<std::vector<ExpectedTest>> menu = menu_of(data, "z_um", {12.0, 5000.0, true, true, true});
  ASSERT_EQ(menu.size(), 4u);
  for (std::size_t k = 0; k < menu.size(); ++k) {
    ASSERT_EQ(menu[k].size(), 3u);
    for (const ExpectedTest& item : menu[k]) {
      EXPECT_NEAR(duration_s(item.schedule), 3600.0 * item.hours, 1e-6) << k;
      EXPECT_LE(item.hours, 12.0);
      EXPECT_EQ(item.max_rpm, 5000.0);
      for (const Dwell& dwell : item.schedule.dwells) {
        EXPECT_LE(dwell.speed_rpm, 5000.0) << k;
        EXPECT_GT(dwell.duration_s, 0.0) << k;
      }
      EXPECT_LE(duration_s(item.schedule) / item.schedule.reading_s, 2000.0 + 1e-6);
      EXPECT_EQ(moves_the_room(item), k == 3) << k;
    }
  }
  EXPECT_EQ(menu_of(data, "z_um", {12.0, 5000.0, false, false, false}).size(), 3u);
}

TEST(test_plan, columns_follow_the_speed_as_they_did_and_are_rounded) {
  const Series data = one_speed(false);
  std::mt19937_64 random(1);
  const Series run =
      inputs_under({{{3600.0, 0.0}, {14400.0, 3000.0}}, 60.0, false}, planned_inputs(data, "z_um"), random);
  EXPECT_EQ(find_column(run, "z_um"), nullptr);
  const std::vector<double>& housing = find_column(run, "T_housing_degC")->values;
  const std::vector<double>& room = find_column(run, "T_room_degC")->values;
  // Of an exponent that one speed leaves open: half the speed warms by an eighth to a half.
  EXPECT_GT(housing.back() - housing.front(), 0.5);
  EXPECT_LT(housing.back() - housing.front(), 6.0);
  for (const double value : housing) EXPECT_NEAR(10.0 * value, std::round(10.0 * value), 1e-6);
  EXPECT_GT(*std::max_element(room.begin(), room.end()) - *std::min_element(room.begin(), room.end()), 0.5);
}

TEST(test_plan, a_step_of_the_room_is_in_the_room_and_in_what_follows_it) {
  const PlannedInputs planned = planned_inputs(one_speed(false), "z_um");
  const std::vector<Dwell> still{{3600.0, 0.0}, {3600.0, 0.0}}, warmer{{3600.0, 0.0}, {3600.0, 0.0, 1.0, 3.0}};
  std::mt19937_64 one(1), other(1);
  const Series a = inputs_under({still, 60.0, false}, planned, one);
  const Series b = inputs_under({warmer, 60.0, false}, planned, other);
  EXPECT_NEAR(find_column(b, "T_room_degC")->values.back() - find_column(a, "T_room_degC")->values.back(), 3.0, 0.11);
}

TEST(test_plan, a_sensor_logged_twice_is_one) {
  const DistinctColumns distinct = distinct_columns_of(one_speed(true), constant(), 0);
  ASSERT_EQ(distinct.equal.size(), 1u);
  EXPECT_EQ(distinct.equal[0].column, "T_housing_degC");
  EXPECT_EQ(distinct.equal[0].other, "T_twin_degC");
  EXPECT_EQ(find_column(distinct.data, "T_twin_degC"), nullptr);
  EXPECT_TRUE(distinct_columns_of(one_speed(false), constant(), 0).equal.empty());
}

TEST(test_plan, what_is_inseparable_is_said_before_any_test) {
  const TestPlan plan = test_plan(constant(), one_speed(true), 0, {.most_hours = 4.0});
  ASSERT_FALSE(plan.inseparable.empty());
  const auto holds_twin = [](const std::vector<BoundEffect>& group) {
    return std::any_of(group.begin(), group.end(),
                       [](const BoundEffect& one) { return one.columns == std::vector<std::string>{"T_twin_degC"}; });
  };
  EXPECT_TRUE(std::any_of(plan.inseparable.begin(), plan.inseparable.end(), holds_twin));
}

// In noise of 0.3 um the housing itself is known already: one of 0.7 um leaves open what follows the speed.
TEST(test_plan, a_plan_of_changing_speeds_decides_what_one_speed_left_open) {
  const TestPlan plan = test_plan(constant(), one_speed(false, 0.7), 0, {.most_hours = 4.0});
  EXPECT_FALSE(plan.is_decided);
  ASSERT_FALSE(plan.tests.empty());
  EXPECT_GT(plan.tests.front().p_right, 0.3);
  EXPECT_EQ(plan.tests.front().hours, 4.0);
  ASSERT_GE(plan.curves.size(), 2u);
  EXPECT_EQ(plan.curves.front().um.size(), plan.time_s.size());
  EXPECT_EQ(plan.curves.front().um.front(), 0.0);
  const TestPlan again = test_plan(constant(), one_speed(false, 0.7), 0, {.most_hours = 4.0});
  ASSERT_EQ(again.tests.size(), plan.tests.size()) << "the same seed, the same plan";
  for (std::size_t k = 0; k < plan.tests.size(); ++k) {
    EXPECT_EQ(again.tests[k].p_right, plan.tests[k].p_right) << k;
    EXPECT_EQ(again.tests[k].speeds, plan.tests[k].speeds) << k;
  }
}

// Beside a model that has one of two temperatures, their difference and the other one alone are the same.
TEST(test_plan, what_the_model_makes_alike_is_said) {
  Series data = one_speed(false);
  std::vector<double> bearing(data.time_s.size()), heat(data.time_s.size());
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] = find_column(data, "speed_rpm")->values[i] > 0.0 ? 12.0 : 0.0;
  low_pass(
      data.time_s, [&](std::size_t i) { return heat[i]; }, 600.0, bearing.data());
  for (std::size_t i = 0; i < heat.size(); ++i) {
    data.columns[3].values[i] += 1.2 * bearing[i];
    bearing[i] = std::round(10.0 * (20.0 + bearing[i])) / 10.0;
  }
  data.columns.insert(data.columns.begin(), {"T_bearing_degC", Role::bearing, bearing});
  Model model = constant();
  model.terms = {term_of("expansion", {"T_housing_degC"})};
  const TestPlan plan = test_plan(model, data, 0, {.most_hours = 4.0});
  ASSERT_FALSE(plan.inseparable.empty());
  const std::vector<BoundEffect>& group = plan.inseparable.front();
  ASSERT_GE(group.size(), 2u);
  EXPECT_NE(group[0].columns, group[1].columns);
}

TEST(test_plan, readings_that_do_not_change_allow_no_plan) {
  Series data = one_speed(false);
  data.columns[3].values.assign(data.time_s.size(), 2.0);
  const TestPlan plan = test_plan(constant(), data, 0, {});
  EXPECT_EQ(plan.obstacle, Obstacle::still_readings);
  EXPECT_TRUE(plan.tests.empty());
}

TEST(test_plan, recordings_are_refused) {
  Model model = constant();
  model.level = Level::recording;
  EXPECT_THROW(test_plan(model, one_speed(false), 0, {}), Error);
}

}  // namespace
}  // namespace ballbar
