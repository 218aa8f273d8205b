#include "ballbar/history/history.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

MachineTest test_on(double day, double play_um, double sigma_um = 0.1) {
  MachineTest test;
  test.file = "day " + std::to_string(day);
  test.started_s = static_cast<std::int64_t>(day * kDay_s);
  test.feed_mm_per_min = 1000.0;
  test.quantities = {{"play", "um", play_um, sigma_um}, {"centre_a", "um", 7.0 * play_um, sigma_um, true}};
  return test;
}

TEST(test_groups, what_may_be_compared) {
  std::vector<MachineTest> tests(9, test_on(0, 1));
  tests[1].feed_mm_per_min = 1049.0;
  tests[2].feed_mm_per_min = 1200.0;
  tests[3].nominal_length_mm = 150.0;
  tests[4].plane = Plane::ZX;
  tests[5].bar = "K1";
  tests[6].arc_deg = 220.0;
  tests[7].start_deg = 180.0;  // of a full circle
  tests[8].started_s.reset();
  const auto groups = groups_of(tests);
  std::vector<std::vector<std::size_t>> places;
  for (const TestGroup& group : groups) places.push_back(group.tests);
  const std::vector<std::vector<std::size_t>> expected{{6}, {8, 0, 1, 7}, {2}, {3}, {5}, {4}};
  EXPECT_EQ(places, expected);
}

TEST(test_groups, an_arc_may_start_about_0_deg) {
  std::vector<MachineTest> tests(3, test_on(0, 1));
  for (MachineTest& test : tests) test.arc_deg = 220.0;
  tests[0].start_deg = 359.9;
  tests[1].start_deg = 0.1;
  tests[2].start_deg = 250.0;
  const auto groups = groups_of(tests);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].tests, (std::vector<std::size_t>{0, 1}));
}

// 1.0 +- 0.1 and 1.5 +- 0.2: 0.5 +- 0.2236, 2.236 sigma. 2.6 * 0.2236 = 0.5814.
TEST(history, change_is_held_against_both_sigmas) {
  std::vector<MachineTest> tests{test_on(0, 1.0, 0.1), test_on(40, 1.5, 0.2)};
  const QuantityHistory play = history_of(tests).at(0).groups.at(0).quantities.at(0);
  ASSERT_TRUE(play.change);
  EXPECT_NEAR(play.change->value, 0.5, 1e-12);
  EXPECT_NEAR(play.change->sigma, std::sqrt(0.05), 1e-12);
  EXPECT_FALSE(play.change->significant);
  EXPECT_EQ(play.change->since_s, 0);
  EXPECT_FALSE(play.trend);
  tests[1].quantities[0].value = 1.59;
  EXPECT_TRUE(history_of(tests)[0].groups[0].quantities[0].change->significant);
  tests[1].quantities[0].sigma = kUnknown;
  EXPECT_FALSE(history_of(tests)[0].groups[0].quantities[0].change->significant) << "stored: not known";
}

TEST(history, where_the_bar_was_put_has_none) {
  const std::vector<MachineTest> tests{test_on(0, 1), test_on(40, 2), test_on(80, 3)};
  const QuantityHistory centre = history_of(tests)[0].groups[0].quantities[1];
  EXPECT_EQ(centre.name, "centre_a");
  EXPECT_FALSE(centre.change);
  EXPECT_FALSE(centre.trend);
}

// 2 um a year from 1 um at day 0: 5 um after two years. 12 quarterly tests, exact but for their sigma of 0.1.
TEST(history, tolerance_is_met_when_the_line_is_there) {
  std::vector<MachineTest> tests;
  for (int i = 0; i < 5; ++i) tests.push_back(test_on(91.3125 * i, 1.0 + 0.5 * i));
  const std::vector<Tolerance> tolerances{{"play", -5.0, 5.0}};
  const QuantityHistory play = history_of(tests, tolerances)[0].groups[0].quantities[0];
  ASSERT_TRUE(play.trend);
  EXPECT_NEAR(play.trend->rate_per_year, 2.0, 1e-6);
  ASSERT_TRUE(play.date);
  EXPECT_EQ(play.date->outlook, Outlook::expected);
  EXPECT_NEAR(*play.date->at_s / kDay_s, 2.0 * 365.25, 3.0) << "the chance is not quite even to both sides";
  EXPECT_LT(*play.date->earliest_s, *play.date->at_s);
  ASSERT_TRUE(play.date->latest_s);
  EXPECT_GT(*play.date->latest_s, *play.date->at_s);
  EXPECT_GT(*play.date->earliest_s / kDay_s, 365.25) << "the last test";
}

TEST(history, other_outlooks) {
  std::vector<MachineTest> tests;
  for (int i = 0; i < 5; ++i) tests.push_back(test_on(91.3125 * i, 1.0 + 0.5 * i));
  const auto outlook = [&](const Tolerance& tolerance) {
    const std::vector<Tolerance> tolerances{tolerance};
    return history_of(tests, tolerances)[0].groups[0].quantities[0].date->outlook;
  };
  EXPECT_EQ(outlook({"play", {}, 2.9}), Outlook::beyond);
  EXPECT_EQ(outlook({"play", -5.0, {}}), Outlook::away) << "it rises";
  EXPECT_EQ(outlook({"play", {}, 100.0}), Outlook::away) << "in 50 years";
  for (MachineTest& test : tests) test.quantities[0].value = 1.0;
  EXPECT_EQ(outlook({"play", -5.0, 5.0}), Outlook::no_trend);
}

TEST(history, tolerance_of_the_newest_file_counts_where_none_is_given) {
  std::vector<MachineTest> tests{test_on(0, 1), test_on(40, 2)};
  tests[0].tolerances = {{"play", {}, 1.5}};
  EXPECT_FALSE(history_of(tests)[0].groups[0].quantities[0].tolerance);
  tests[1].tolerances = {{"play", {}, 1.5}};
  EXPECT_EQ(history_of(tests)[0].groups[0].quantities[0].date->outlook, Outlook::beyond);
  const std::vector<Tolerance> given{{"play", {}, 3.0}};
  EXPECT_EQ(history_of(tests, given)[0].groups[0].quantities[0].date->outlook, Outlook::no_trend);
}

TEST(history, machines_are_kept_apart) {
  std::vector<MachineTest> tests{test_on(0, 1), test_on(40, 2), test_on(80, 3)};
  tests[0].machine = tests[2].machine = "mill 7";
  auto machines = history_of(tests);
  ASSERT_EQ(machines.size(), 1u) << "the one without a name is the only machine's";
  tests[1].machine = "mill 5";
  machines = history_of(tests);
  ASSERT_EQ(machines.size(), 2u);
  EXPECT_EQ(machines[0].machine, "mill 5");
  EXPECT_EQ(machines[0].groups[0].group.tests, (std::vector<std::size_t>{1}));
  EXPECT_EQ(machines[1].groups[0].quantities[0].tests, (std::vector<std::size_t>{0, 2}));
}

TEST(history, tests_without_a_date_stand_beside) {
  std::vector<MachineTest> tests{test_on(0, 1), test_on(40, 2)};
  tests[1].started_s.reset();
  const QuantityHistory play = history_of(tests)[0].groups[0].quantities[0];
  EXPECT_EQ(play.tests, (std::vector<std::size_t>{0}));
  EXPECT_FALSE(play.change);
  EXPECT_EQ(play.last_value, 1.0);
}

TEST(history, what_a_test_does_not_determine_is_no_value) {
  std::vector<MachineTest> tests{test_on(0, 1.0), test_on(40, 50.0, std::numeric_limits<double>::infinity()),
                                 test_on(80, 1.1)};
  const QuantityHistory play = history_of(tests)[0].groups[0].quantities[0];
  EXPECT_EQ(play.tests, (std::vector<std::size_t>{0, 2}));
  EXPECT_NEAR(play.change->value, 0.1, 1e-12);
  EXPECT_FALSE(play.trend) << "two values";
}

// A hundred times the tests take some hundred times as long, and a step that looks at all others ten thousand.
TEST(history, time_grows_with_the_number_of_tests) {
  const auto seconds = [](int count) {
    std::vector<MachineTest> tests;
    for (int i = 0; i < count; ++i) tests.push_back(test_on(7.0 * i, 1.0 + 0.01 * (i % 7)));
    double least = 1e9;
    for (int k = 0; k < 3; ++k) {
      const auto start = std::chrono::steady_clock::now();
      EXPECT_EQ(history_of(tests).size(), 1u);
      least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return least;
  };
  EXPECT_LT(seconds(50000), 2000.0 * seconds(500));
}

// Two sweeps of 220 deg from 250 deg, at mid-sample.
TEST(machine_test, of_recordings) {
  std::vector<Recording> recordings(2);
  for (Recording& one : recordings) {
    one.plane = Plane::ZX;
    one.feed_mm_per_min = 1000.0;
    one.started_s = 5000;
    for (int i = 0; i < 440; ++i) one.angle_rad.push_back(rad_from_deg(250.0 + 0.5 * (i + 0.5)));
    one.length_mm.assign(440, 100.0);
  }
  recordings[1].feed_mm_per_min = 1010.0;
  recordings[1].started_s = 4000;
  MachineErrors errors;
  errors.errors = {{"centre_a", "um", 3.0, 0.1}, {"global_scale", "um", 1.0, 0.2}};
  errors.covariance = Eigen::Vector3d(0.01, 0.04, 0.01).asDiagonal();
  errors.circularity_um = 5.0;
  errors.residual_rms_um = 0.5;
  errors.errors.push_back({"play", "um", 0.5, 0.1});
  errors.ranked.push_back({.rows = {2}, .significant = false});
  errors.noise.white_um = 0.3;
  errors.noise.correlated_um = 0.4;
  errors.noise.correlation_time_s = 0.0;
  const MachineTest test = machine_test(errors, recordings);
  EXPECT_EQ(test.plane, Plane::ZX);
  EXPECT_NEAR(test.start_deg, 250.0, 1e-9);
  EXPECT_NEAR(test.arc_deg, 220.0, 1e-9);
  EXPECT_EQ(test.feed_mm_per_min, 1005.0);
  EXPECT_EQ(test.started_s, 4000);
  ASSERT_GE(test.quantities.size(), 5u);
  EXPECT_TRUE(test.quantities[0].of_set_up);
  EXPECT_FALSE(test.quantities[1].of_set_up);
  EXPECT_TRUE(test.quantities[1].significant);
  EXPECT_FALSE(test.quantities[2].significant) << "the error does not show";
  EXPECT_EQ(test.quantities[3].name, "circularity");
  EXPECT_NEAR(test.quantities[3].sigma, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(test.quantities[4].sigma, 0.5 / std::sqrt(2.0 * 880.0), 1e-12) << "no memory: all readings count";
}

}  // namespace
}  // namespace ballbar
