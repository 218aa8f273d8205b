#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "ballbar/error.hpp"
#include "ballbar/history/history.hpp"
#include "history/calls.hpp"
#include "history/robust_fit.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

// What happens to a machine: how much it adds to one quantity at a time, years.
using Fate = std::function<double(const std::string& quantity, double years)>;

struct MadeQuantity {
  const char* name;
  const char* unit;
  double level, scatter;
};
constexpr MadeQuantity kMade[] = {
    {"squareness", "um/m", 8.0, 1.5},       {"backlash_a_pos", "um", 1.5, 0.2},     {"backlash_a_neg", "um", 1.4, 0.2},
    {"cyclic_error_a_fwd", "um", 0.8, 0.1}, {"cyclic_error_a_rev", "um", 0.8, 0.1}, {"straightness_b", "um", 0.5, 0.2},
    {"scale_x", "um/m", 12.0, 1.5},         {"scale_y", "um/m", -7.0, 1.5},         {"global_scale", "um", 0.25, 0.12}};

// A test a month for three years, from 2020-01-15 on, the scatter normal.
void add_machine(std::vector<MachineTest>& tests, const std::string& name, unsigned seed, const Fate& fate = nullptr,
                 int months = 36) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int month = 0; month < months; ++month) {
    const double years = month / 12.0;
    MachineTest test;
    test.file = name + "/" + std::to_string(month) + ".b5r";
    test.machine = name;
    test.bar = "B1";
    test.started_s = 1579046400 + static_cast<std::int64_t>(years * kYear_s);
    test.feed_mm_per_min = 1000.0;
    for (const MadeQuantity& made : kMade) {
      double value = made.level + made.scatter * normal(random);
      if (fate) value += fate(made.name, years);
      test.quantities.push_back({made.name, made.unit, value, 0.3 * made.scatter});
    }
    test.quantities.push_back({"centre_a", "um", 10.0 * years, 0.1, true});
    tests.push_back(test);
  }
}

std::vector<MachineTest> plain_fleet(unsigned machines = 20) {
  std::vector<MachineTest> tests;
  for (unsigned i = 0; i < machines; ++i) add_machine(tests, "plain-" + std::to_string(i), 3000 + i);
  return tests;
}

const MachineHistory& machine_called(const History& history, const std::string& name) {
  const auto found = std::find_if(history.machines.begin(), history.machines.end(),
                                  [&](const MachineHistory& one) { return one.name == name; });
  EXPECT_NE(found, history.machines.end()) << name;
  return *found;
}

std::vector<std::string> names_in(const Finding& finding) {
  std::vector<std::string> names;
  for (const FindingQuantity& one : finding.quantities) names.push_back(one.name);
  return names;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// n p_(i) / i: 0.04, 0.06, 0.0533, 0.5, and none larger than one after it.
TEST(false_discovery, q_values_by_hand) {
  const std::vector<double> p{0.01, 0.04, 0.03, 0.5};
  const std::vector<double> q = q_values(p);
  EXPECT_NEAR(q[0], 0.04, 1e-12);
  EXPECT_NEAR(q[1], 4.0 * 0.04 / 3.0, 1e-12);
  EXPECT_NEAR(q[2], 4.0 * 0.04 / 3.0, 1e-12);
  EXPECT_NEAR(q[3], 0.5, 1e-12);
  EXPECT_NEAR(simes(p), 0.04, 1e-12);
  EXPECT_EQ(simes({}), 1.0);
  EXPECT_TRUE(q_values({}).empty());
}

// 9 values at 0 and one far off, s = 1: sum of psi is - 9 m + 2 = 0.
TEST(robust_fit, a_value_far_off_counts_two_scatters) {
  std::vector<double> values(10, 0.0), scatter(10, 1.0);
  values[3] = 1000.0;
  const RobustFit fit = robust_fit(FitColumns::Ones(10, 1), values, scatter);
  EXPECT_NEAR(fit.gains[0], 2.0 / 9.0, 1e-3);
  const double m = fit.gains[0];
  EXPECT_NEAR(fit.loss, 9.0 * m * m + 2.0 * (2.0 * (1000.0 - m) - 2.0), 1e-9);
}

TEST(findings, nothing_is_found_where_nothing_is) {
  const std::vector<MachineTest> tests = plain_fleet();
  const History history = history_of(tests);
  EXPECT_EQ(history.machines.size(), 20u);
  EXPECT_EQ(history.found, 0u);
  EXPECT_EQ(history.judged, 20u * 9u * 3u);
  for (const MachineHistory& machine : history.machines) {
    EXPECT_EQ(machine.need, Need::nothing) << machine.name;
    EXPECT_EQ(text_of(machine.reason), "No significant change.");
    EXPECT_EQ(machine.tests, 36u);
  }
}

TEST(findings, wear_is_a_trend_with_the_date_of_its_tolerance) {
  std::vector<MachineTest> tests = plain_fleet();
  add_machine(tests, "worn", 7, [](const std::string& quantity, double years) {
    return quantity.starts_with("backlash_a") ? 1.0 * years : 0.0;
  });
  HistoryOptions options;
  options.tolerances = {{"backlash_a_pos", -6.0, 6.0}};
  const History history = history_of(tests, options);
  const MachineHistory& worn = history.machines.front();
  EXPECT_EQ(worn.name, "worn");
  EXPECT_EQ(worn.need, Need::expected);
  ASSERT_EQ(worn.findings.size(), 1u);
  const Finding& wear = worn.findings[0];
  EXPECT_EQ(wear.kind, FindingKind::trend);
  EXPECT_EQ(wear.axis, 0);
  EXPECT_EQ(wear.quantities.size(), 2u) << "both sides are one finding";
  EXPECT_NEAR(wear.quantities[0].size, 1.0, 5.0 * wear.quantities[0].sigma);
  EXPECT_LT(wear.quantities[0].sigma, 0.1);
  EXPECT_LT(wear.q_value, 0.001);
  EXPECT_FALSE(wear.remedy.empty());
  ASSERT_EQ(worn.tolerances.size(), 1u);
  // 1.5 um and 1 um a year: 6 um after 4.5 years, in July 2024.
  EXPECT_NEAR(*worn.tolerances[0].date.at_s, 1579046400 + 4.5 * kYear_s, 0.35 * kYear_s);
}

TEST(findings, what_steps_at_one_date_is_one_event) {
  std::vector<MachineTest> tests = plain_fleet();
  add_machine(tests, "hit", 8, [](const std::string& quantity, double years) {
    if (years < 1.7) return 0.0;
    return quantity == "squareness"       ? 15.0
           : quantity == "straightness_b" ? 1.5
           : quantity == "backlash_a_pos" ? 1.5
                                          : 0.0;
  });
  const History history = history_of(tests);
  const MachineHistory& hit = history.machines.front();
  ASSERT_EQ(hit.name, "hit");
  ASSERT_EQ(hit.findings.size(), 1u);
  const Finding& step = hit.findings[0];
  EXPECT_EQ(step.kind, FindingKind::step);
  const std::vector<std::string> names = names_in(step);
  EXPECT_TRUE(holds(names, "squareness") && holds(names, "straightness_b") && holds(names, "backlash_a_pos"));
  EXPECT_NEAR((step.from_s - 1579046400) / kYear_s, 20.0 / 12.0, 0.01);
  EXPECT_NEAR((step.to_s - 1579046400) / kYear_s, 21.0 / 12.0, 0.01);
  EXPECT_NE(text_of(step.sentence).find("collision"), std::string::npos) << text_of(step.sentence);
}

TEST(findings, three_tests_after_a_step_are_enough) {
  std::vector<MachineTest> tests = plain_fleet();
  add_machine(tests, "hit", 8, [](const std::string& quantity, double years) {
    return quantity == "squareness" && years > 2.7 ? 20.0 : 0.0;
  });
  const History history = history_of(tests);
  ASSERT_EQ(history.machines.front().name, "hit");
  EXPECT_EQ(history.machines.front().findings.at(0).kind, FindingKind::step);
  EXPECT_NEAR(history.machines.front().findings[0].quantities[0].size, 20.0, 4.0);
}

TEST(findings, one_test_that_was_set_up_badly_is_nothing) {
  std::vector<MachineTest> tests = plain_fleet();
  add_machine(tests, "bad", 9, [](const std::string& quantity, double years) {
    return std::abs(years - 1.5) < 0.01 && quantity == "squareness" ? 100.0 : 0.0;
  });
  EXPECT_EQ(history_of(tests).found, 0u);
}

TEST(findings, a_season_is_neither_wear_nor_a_step) {
  std::vector<MachineTest> tests = plain_fleet();
  add_machine(tests, "hall", 10, [](const std::string& quantity, double years) {
    const double wave = std::sin(2.0 * std::numbers::pi * years);
    return quantity == "squareness" ? 5.0 * wave : quantity.starts_with("scale_") ? 7.0 * wave : 0.0;
  });
  const History history = history_of(tests);
  ASSERT_EQ(history.machines.front().name, "hall");
  ASSERT_EQ(history.machines.front().findings.size(), 1u);
  const Finding& season = history.machines.front().findings[0];
  EXPECT_EQ(season.kind, FindingKind::season);
  EXPECT_EQ(season.quantities.size(), 3u);
  // A quarter of a year after 2020-01-15.
  EXPECT_NE(text_of(season.sentence).find("highest in April"), std::string::npos) << text_of(season.sentence);
}

TEST(findings, errors_of_one_axis_that_go_together_are_a_new_part) {
  std::vector<MachineTest> tests = plain_fleet();
  add_machine(tests, "screw", 11, [](const std::string& quantity, double years) {
    if (years > 1.4) return 0.0;
    return quantity.starts_with("backlash_a") ? 3.0
           : quantity.starts_with("cyclic")   ? 1.5
           : quantity == "scale_x"            ? 20.0
                                              : 0.0;
  });
  const History history = history_of(tests);
  ASSERT_EQ(history.machines.front().name, "screw");
  ASSERT_EQ(history.machines.front().findings.size(), 1u);
  EXPECT_EQ(history.machines.front().findings[0].kind, FindingKind::replaced_part);
  EXPECT_EQ(history.machines.front().findings[0].axis, 0);
}

TEST(findings, scales_that_step_with_the_bar_are_the_instrument) {
  std::vector<MachineTest> tests = plain_fleet();
  const std::size_t first = tests.size();
  add_machine(tests, "measured", 12, [](const std::string& quantity, double years) {
    if (years < 2.0) return 0.0;
    return quantity == "global_scale" ? 1.2 : quantity.starts_with("scale_") ? 12.0 : 0.0;
  });
  for (std::size_t i = first + 24; i < tests.size(); ++i) tests[i].bar = "B2";
  const History history = history_of(tests);
  ASSERT_EQ(history.machines.front().name, "measured");
  ASSERT_EQ(history.machines.front().findings.size(), 1u);
  const Finding& found = history.machines.front().findings[0];
  EXPECT_EQ(found.kind, FindingKind::instrument);
  EXPECT_NE(text_of(found.sentence).find("from B1 to B2"), std::string::npos) << text_of(found.sentence);
  ASSERT_EQ(history.bar_changes.size(), 1u);
  // 1.2 um over 100 mm.
  EXPECT_NEAR(history.bar_changes[0].size_ppm, 12.0, 5.0 * history.bar_changes[0].sigma_ppm);
  // The same step without another bar is one of the machine's scales, which is said.
  for (MachineTest& test : tests) test.bar = "B1";
  const History alone = history_of(tests);
  EXPECT_EQ(machine_called(alone, "measured").findings.at(0).kind, FindingKind::step);
}

TEST(findings, one_bar_calibrated_anew_steps_on_all_its_machines) {
  std::vector<MachineTest> tests = plain_fleet();
  for (const unsigned i : {0U, 1U}) {
    const std::size_t first = tests.size();
    add_machine(tests, "with-b7-" + std::to_string(i), 20 + i, [](const std::string& quantity, double years) {
      if (years < 1.6) return 0.0;
      return quantity == "global_scale" ? -1.5 : quantity.starts_with("scale_") ? -15.0 : 0.0;
    });
    for (std::size_t k = first; k < tests.size(); ++k) tests[k].bar = "B7";
  }
  const History history = history_of(tests);
  for (const char* name : {"with-b7-0", "with-b7-1"}) {
    const MachineHistory& machine = machine_called(history, name);
    ASSERT_EQ(machine.findings.size(), 1u) << name;
    EXPECT_EQ(machine.findings[0].kind, FindingKind::instrument);
  }
}

TEST(findings, ranks_by_what_is_needed) {
  std::vector<MachineTest> tests = plain_fleet();
  const auto growing = [](double a_year) {
    return [a_year](const std::string& quantity, double years) {
      return quantity == "backlash_a_pos" ? a_year * years : 0.0;
    };
  };
  add_machine(tests, "later", 31, growing(0.6));
  add_machine(tests, "soon", 32, growing(1.0));
  add_machine(tests, "beyond", 33, growing(2.0));
  add_machine(tests, "stepped", 34, [](const std::string& quantity, double years) {
    return quantity == "squareness" && years > 1.0 ? 12.0 : 0.0;
  });
  HistoryOptions options;
  options.tolerances = {{"backlash_a_pos", -5.0, 5.0}};
  const History history = history_of(tests, options);
  std::vector<std::string> order;
  for (std::size_t i = 0; i < 5; ++i) order.push_back(history.machines[i].name);
  EXPECT_EQ(order, (std::vector<std::string>{"beyond", "soon", "later", "stepped", "plain-0"}));
  EXPECT_EQ(history.machines[0].need, Need::beyond);
  EXPECT_NE(text_of(history.machines[0].reason).find("beyond its tolerance of 5 um"), std::string::npos);
}

TEST(findings, the_order_of_the_tests_is_nothing) {
  std::vector<MachineTest> tests = plain_fleet(8);
  add_machine(tests, "worn", 7, [](const std::string& quantity, double years) {
    return quantity == "backlash_a_pos" ? 0.8 * years : 0.0;
  });
  const History one = history_of(tests);
  std::mt19937 random(3);
  std::shuffle(tests.begin(), tests.end(), random);
  const History other = history_of(tests);
  ASSERT_EQ(one.machines.size(), other.machines.size());
  for (std::size_t i = 0; i < one.machines.size(); ++i) {
    EXPECT_EQ(one.machines[i].name, other.machines[i].name);
    EXPECT_EQ(text_of(one.machines[i].reason), text_of(other.machines[i].reason));
  }
}

TEST(findings, takes_stored_values_two_tests_a_day_and_few_tests) {
  std::vector<MachineTest> tests = plain_fleet(10);
  for (MachineTest& test : tests) {
    for (TestQuantity& quantity : test.quantities) quantity.sigma = kUnknown;
  }
  add_machine(tests, "few", 40, nullptr, 3);
  add_machine(tests, "one", 41, nullptr, 1);
  add_machine(tests, "twice", 42, nullptr, 24);
  const std::vector<MachineTest> again(tests.end() - 24, tests.end());
  tests.insert(tests.end(), again.begin(), again.end());
  add_machine(tests, "", 43, nullptr, 2);
  tests.back().started_s.reset();
  const History history = history_of(tests);
  EXPECT_EQ(history.found, 0u);
  EXPECT_EQ(history.without_date.size(), 1u);
  EXPECT_EQ(machine_called(history, "twice").tests, 48u);
  EXPECT_EQ(text_of(machine_called(history, "one").reason), "There are too few tests to show a step or a trend.");
}

// Three machines tell no scatter of a quantity: the line of each is held against the sigmas of its fits, 0.1 um.
TEST(findings, of_few_machines_and_tests_a_clear_trend_is_found) {
  std::vector<MachineTest> tests;
  for (const double um_a_year : {0.0, 3.0}) {
    for (int month = 0; month <= 12; month += 3) {
      MachineTest test;
      test.machine = um_a_year > 0.0 ? "worn" : "new";
      test.started_s = 1579046400 + static_cast<std::int64_t>(month / 12.0 * kYear_s);
      const double set_up_um = month % 2 == 0 ? 0.05 : -0.05;
      test.quantities = {{"backlash_a_pos", "um", 1.0 + um_a_year * month / 12.0 + set_up_um, 0.1}};
      tests.push_back(test);
    }
  }
  const History history = history_of(tests);
  EXPECT_EQ(history.judged, 2u) << "a trend each: five tests tell no step";
  EXPECT_EQ(machine_called(history, "worn").findings.at(0).kind, FindingKind::trend);
  EXPECT_NEAR(machine_called(history, "worn").findings[0].quantities[0].size, 3.0, 0.4);
  EXPECT_TRUE(machine_called(history, "new").findings.empty());
}

TEST(findings, one_value_again_and_again_is_nothing) {
  std::vector<MachineTest> tests = plain_fleet(4);
  for (MachineTest& test : tests) {
    for (TestQuantity& quantity : test.quantities) quantity = {quantity.name, quantity.unit, 1.0, kUnknown};
  }
  EXPECT_EQ(history_of(tests).found, 0u);
  EXPECT_TRUE(history_of({}).machines.empty());
}

TEST(findings, refuses_a_rate_that_is_none) {
  HistoryOptions options;
  options.false_discovery_rate = 0.0;
  try {
    history_of({}, options);
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "The false discovery rate: expected a number between 0 and 1, found 0.");
  }
}

}  // namespace
}  // namespace ballbar
