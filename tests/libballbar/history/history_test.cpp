#include "ballbar/history/history.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

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

std::vector<TestGroup> groups_of_all(const std::vector<MachineTest>& tests) {
  std::vector<std::size_t> places(tests.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
  return groups_of(tests, places);
}

// The machine with every quantity.
MachineHistory machine_of(const std::vector<MachineTest>& tests, const std::vector<Tolerance>& tolerances = {}) {
  HistoryOptions options;
  options.tolerances = tolerances;
  options.every_quantity = true;
  return history_of(tests, options).machines.at(0);
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
  std::vector<std::vector<std::size_t>> places;
  for (const TestGroup& group : groups_of_all(tests)) places.push_back(group.tests);
  const std::vector<std::vector<std::size_t>> expected{{6}, {8, 0, 1, 5, 7}, {2}, {3}, {4}};
  EXPECT_EQ(places, expected);
}

TEST(test_groups, an_arc_may_start_about_0_deg) {
  std::vector<MachineTest> tests(3, test_on(0, 1));
  for (MachineTest& test : tests) test.arc_deg = 220.0;
  tests[0].start_deg = 359.9;
  tests[1].start_deg = 0.1;
  tests[2].start_deg = 250.0;
  const auto groups = groups_of_all(tests);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].tests, (std::vector<std::size_t>{0, 1}));
}

TEST(history, where_the_bar_was_put_has_none) {
  const MachineHistory machine = machine_of({test_on(0, 1), test_on(40, 2), test_on(80, 3)});
  ASSERT_EQ(machine.series.size(), 1u);
  EXPECT_EQ(machine.series[0].name, "play");
  EXPECT_EQ(machine.series[0].value, (std::vector<double>{1.0, 2.0, 3.0}));
}

// 1 um +- 0.1 is beyond 2.6 sigmas, 0.2 um +- 0.1 is not.
TEST(history, the_last_value_is_significant_by_its_sigma) {
  EXPECT_TRUE(machine_of({test_on(0, 0.2), test_on(40, 1.0)}).series[0].significant);
  EXPECT_FALSE(machine_of({test_on(0, 1.0), test_on(40, 0.2)}).series[0].significant);
  EXPECT_FALSE(machine_of({test_on(0, 1.0, kUnknown)}).series[0].significant) << "stored: not known";
}

// 2 um a year from 1 um at day 0: 5 um after two years. 5 quarterly tests, exact but for their sigma of 0.1.
TEST(history, tolerance_is_met_when_the_line_is_there) {
  std::vector<MachineTest> tests;
  for (int i = 0; i < 5; ++i) tests.push_back(test_on(91.3125 * i, 1.0 + 0.5 * i));
  const MachineHistory machine = machine_of(tests, {{"play", -5.0, 5.0}});
  ASSERT_TRUE(machine.series.at(0).trend);
  EXPECT_NEAR(machine.series[0].trend->rate_per_year, 2.0, 1e-6);
  EXPECT_NEAR(machine.series[0].level, 3.0, 1e-6);
  EXPECT_EQ(machine.need, Need::expected);
  ASSERT_EQ(machine.findings.size(), 1u);
  EXPECT_EQ(machine.findings[0].kind, FindingKind::trend);
  EXPECT_EQ(machine.findings[0].quantities[0].size, machine.series[0].trend->rate_per_year) << "one line, one rate";
  const ToleranceDate& date = machine.tolerances.at(0).date;
  EXPECT_EQ(date.outlook, Outlook::expected);
  EXPECT_NEAR(*date.at_s / kDay_s, 2.0 * 365.25, 3.0) << "the chance is not quite even to both sides";
  EXPECT_LT(*date.earliest_s, *date.at_s);
  ASSERT_TRUE(date.latest_s);
  EXPECT_GT(*date.latest_s, *date.at_s);
  EXPECT_GT(*date.earliest_s / kDay_s, 365.25) << "the last test";
}

TEST(history, other_outlooks) {
  std::vector<MachineTest> tests;
  for (int i = 0; i < 5; ++i) tests.push_back(test_on(91.3125 * i, 1.0 + 0.5 * i));
  const auto outlook = [&](const Tolerance& tolerance) {
    return machine_of(tests, {tolerance}).tolerances.at(0).date.outlook;
  };
  EXPECT_EQ(outlook({"play", {}, 2.9}), Outlook::beyond);
  EXPECT_EQ(outlook({"play", -5.0, {}}), Outlook::away) << "it rises";
  EXPECT_EQ(outlook({"play", {}, 100.0}), Outlook::away) << "in 50 years";
  for (MachineTest& test : tests) test.quantities[0].value = 1.0;
  EXPECT_EQ(outlook({"play", -5.0, 5.0}), Outlook::no_trend);
}

// The level of 1 um and 9 um is 5 um: beyond 1.5 um; of three tests of 1 um and one of 9 um it is near 1 um.
TEST(history, tolerance_of_the_newest_file_counts_where_none_is_given) {
  std::vector<MachineTest> tests{test_on(0, 1), test_on(40, 9)};
  tests[0].tolerances = {{"play", {}, 1.5}};
  EXPECT_TRUE(machine_of(tests).tolerances.empty());
  tests[1].tolerances = {{"play", {}, 1.5}};
  EXPECT_EQ(machine_of(tests).tolerances.at(0).date.outlook, Outlook::beyond);
  EXPECT_EQ(machine_of(tests, {{"play", {}, 30.0}}).tolerances.at(0).date.outlook, Outlook::no_trend);
}

TEST(history, a_last_test_alone_beyond_its_tolerance_is_measured_again) {
  std::vector<MachineTest> tests;
  for (int i = 0; i < 8; ++i) tests.push_back(test_on(40.0 * i, i < 7 ? 1.0 + 0.01 * (i % 2) : 9.0));
  const MachineHistory machine = machine_of(tests, {{"play", {}, 3.0}});
  EXPECT_EQ(machine.need, Need::nothing);
  EXPECT_TRUE(machine.tolerances.at(0).last_alone);
  EXPECT_EQ(text_of(machine.reason),
            "play XY of the last test is beyond its tolerance, earlier ones are not. Measure again.");
}

TEST(history, last_is_the_last_test_of_a_day_and_not_its_mean) {
  const MachineHistory machine =
      machine_of({test_on(0, 1), test_on(40, 4), test_on(40.1, 2, 0.3)}, {{"play", {}, 2.5}});
  const QuantityHistory& play = machine.series.at(0);
  EXPECT_EQ(play.value.back(), 3.0);
  EXPECT_EQ(play.last, 2.0);
  EXPECT_EQ(play.last_sigma, 0.3);
  EXPECT_FALSE(machine.tolerances.at(0).last_alone) << "the last test is within";
}

TEST(history, machines_have_their_own) {
  std::vector<MachineTest> tests{test_on(0, 1), test_on(40, 2), test_on(80, 3)};
  tests[0].machine = tests[2].machine = "mill 7";
  History history = history_of(tests);
  ASSERT_EQ(history.machines.size(), 1u) << "the one without a name is the only machine's";
  EXPECT_EQ(history.machines[0].groups.at(0).tests, (std::vector<std::size_t>{0, 1, 2}));
  tests[1].machine = "mill 5";
  history = history_of(tests);
  ASSERT_EQ(history.machines.size(), 2u);
  EXPECT_EQ(history.machines[0].name, "mill 5");
  EXPECT_EQ(history.machines[0].groups[0].tests, (std::vector<std::size_t>{1}));
  EXPECT_EQ(history.machines[1].groups[0].tests, (std::vector<std::size_t>{0, 2}));
  EXPECT_TRUE(history.machines[1].series.empty()) << "nothing was found";
}

TEST(history, tests_without_a_date_are_in_nothing) {
  std::vector<MachineTest> tests{test_on(0, 1), test_on(40, 2)};
  tests[1].started_s.reset();
  tests[1].file = "undated";
  EXPECT_EQ(machine_of(tests).series.at(0).tests, (std::vector<std::size_t>{0}));
  EXPECT_EQ(history_of(tests).without_date, (std::vector<std::string>{"undated"}));
}

TEST(history, what_a_test_does_not_determine_is_no_value) {
  const MachineHistory machine =
      machine_of({test_on(0, 1.0), test_on(40, 50.0, std::numeric_limits<double>::infinity()), test_on(80, 1.1)});
  EXPECT_EQ(machine.series.at(0).tests, (std::vector<std::size_t>{0, 2}));
  EXPECT_FALSE(machine.series[0].trend) << "two values";
}

// A hundred times the tests take some hundred times as long, and a step that looks at all others ten thousand.
TEST(history, time_grows_with_the_number_of_tests) {
  const auto seconds = [](int count) {
    std::vector<MachineTest> tests;
    for (int i = 0; i < count; ++i) tests.push_back(test_on(7.0 * i, 1.0 + 0.01 * (i % 7)));
    double least = 1e9;
    for (int k = 0; k < 3; ++k) {
      const auto start = std::chrono::steady_clock::now();
      EXPECT_EQ(history_of(tests).machines.size(), 1u);
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
