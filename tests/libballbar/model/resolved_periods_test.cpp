#include "model/resolved_periods.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"

namespace ballbar {
namespace {

std::vector<double> rows_every(double step_s, std::size_t count) {
  std::vector<double> time_s(count);
  for (std::size_t i = 0; i < count; ++i) time_s[i] = step_s * static_cast<double>(i);
  return time_s;
}

const Setting& period_of(const Term& term) { return term.settings[2]; }

TEST(ResolvedPeriods, the_highest_frequency_is_half_the_usual_rate) {
  EXPECT_DOUBLE_EQ(highest_Hz(rows_every(60.0, 10)), 1.0 / 120.0);
  EXPECT_DOUBLE_EQ(highest_Hz(std::vector<double>{0.0, 60.0, 120.0, 121.0, 181.0, 241.0}), 1.0 / 120.0);
  EXPECT_TRUE(std::isinf(highest_Hz(std::vector<double>{5.0})));
}

TEST(ResolvedPeriods, a_free_period_is_two_rows_at_least) {
  const Term cycle = term_of("thermostat_cycle", {});
  EXPECT_DOUBLE_EQ(period_of(with_resolved_periods(cycle, 1.0 / 600.0)).lower, 600.0);
  EXPECT_DOUBLE_EQ(period_of(with_resolved_periods(cycle, 1.0 / 1200.0)).start, 1200.0);
  EXPECT_EQ(with_resolved_periods(cycle, 1.0), cycle);
  Term held = cycle;
  held.settings[2].held = true;
  EXPECT_EQ(with_resolved_periods(held, 1.0 / 600.0), held);
  Term stated = cycle;
  stated.settings[2].start = 300.0;
  stated.settings[2].stated = true;
  EXPECT_EQ(with_resolved_periods(stated, 1.0 / 600.0), stated);
}

TEST(ResolvedPeriods, what_repeats_faster_than_the_rows_is_not_searched) {
  const auto testability = [](double step_s) {
    Series data;
    data.time_s = rows_every(step_s, 60);
    Column y{"y_um", Role::measured, {}};
    for (std::size_t i = 0; i < 60; ++i) y.values.push_back(std::sin(0.9 * static_cast<double>(i * i)));
    data.columns.push_back(y);
    Model model;
    model.targets = {"y_um"};
    for (const Detectability& one : preflight(model, data).detectability) {
      if (one.effect->name == "thermostat_cycle") return one.testability;
    }
    return Testability::other_motion;
  };
  EXPECT_EQ(testability(60.0), Testability::testable);
  EXPECT_EQ(testability(400.0), Testability::testable);
  EXPECT_EQ(testability(480.0), Testability::rows_too_far_apart);  // a period of 15 min
}

// A cycle of 409.5 s at rows 480 s apart is one of 46.5 min in disguise.
TEST(ResolvedPeriods, a_fit_takes_no_cycle_that_the_rows_do_not_show) {
  Series data;
  data.time_s = rows_every(480.0, 40);
  Column y{"y_um", Role::measured, {}};
  for (const double t : data.time_s) y.values.push_back(std::sin(2.0 * std::numbers::pi * t / 409.5));
  data.columns.push_back(y);
  Model model;
  model.targets = {"y_um"};
  model.terms.push_back(term_of("thermostat_cycle", {}));
  const Fit fitted = fit(model, data);
  for (const FittedParameter& one : fitted.parameters) {
    if (one.name != "period_s") continue;
    EXPECT_NEAR(one.value, 1.0 / (1.0 / 409.5 - 1.0 / 480.0), 5.0);
  }
}

}  // namespace
}  // namespace ballbar
