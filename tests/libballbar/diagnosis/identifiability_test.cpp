#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"

namespace ballbar {
namespace {

// A day of a room that warms and cools, one row a minute, and a target that does nothing but be measured.
Series day() {
  Series series;
  Column room{"T_room_degC", Role::ambient, {}}, target{"y_um", Role::measured, {}};
  for (int minute = 0; minute < 1440; ++minute) {
    series.time_s.push_back(60.0 * minute);
    room.values.push_back(20.0 + 3.0 * std::sin(minute / 90.0) + 0.5 * std::sin(minute / 7.0));
    target.values.push_back(0.1 * std::sin(12.9 * minute * minute));  // no two rows alike
  }
  series.columns = {room, target};
  return series;
}

const Detectability& detectable(const Preflight& found, const std::string& name) {
  return *std::find_if(found.detectability.begin(), found.detectability.end(),
                       [&](const Detectability& one) { return one.effect->name == name; });
}

double likeness(const Detectability& of, const std::string& with) {
  const auto at =
      std::find_if(of.imitated_by.begin(), of.imitated_by.end(), [&](const Likeness& one) { return one.with == with; });
  return at == of.imitated_by.end() ? -1.0 : at->coherence;
}

TEST(Identifiability, inseparable_is_what_is_imitated_above_95_percent) {
  Model model;
  model.targets = {"y_um"};
  const Preflight found = preflight(model, day());
  std::size_t testable = 0;
  for (const Detectability& one : found.detectability) testable += one.testability == Testability::testable ? 1 : 0;
  ASSERT_GT(testable, 3u);
  for (const Detectability& one : found.detectability) {
    if (one.testability != Testability::testable) {
      EXPECT_TRUE(one.imitated_by.empty()) << one.effect->name;
      continue;
    }
    EXPECT_EQ(one.imitated_by.size(), testable - 1) << one.effect->name;
    for (const Likeness& other : one.imitated_by) {
      EXPECT_GE(other.coherence, 0.0);
      EXPECT_LE(other.coherence, 1.0);
      const bool told =
          std::find(one.inseparable_from.begin(), one.inseparable_from.end(), other.with) != one.inseparable_from.end();
      EXPECT_EQ(told, other.coherence > 0.95) << one.effect->name << " and " << other.with;
    }
  }
}

// A lag of a minute makes of a slow room nearly the room itself; a step is nothing like it.
TEST(Identifiability, a_short_lag_imitates_expansion) {
  Model model;
  model.targets = {"y_um"};
  const Preflight found = preflight(model, day());
  EXPECT_GT(likeness(detectable(found, "expansion"), "lagged_expansion"), 0.95);
  EXPECT_LT(likeness(detectable(found, "expansion"), "linear_drift"), 0.5);
}

// The facts of why an effect is not testable: one with no column of a unit, one of which the model has all columns, one
// whose column does not change, and one whose column has gaps.
TEST(Identifiability, deficiencies) {
  Model model;
  model.targets = {"y_um"};
  Series data = day();
  const Detectability no_speed = detectable(preflight(model, data), "speed_heating");
  EXPECT_EQ(no_speed.testability, Testability::input_missing);
  EXPECT_EQ(no_speed.deficiency, (Deficiency{.missing_inputs = {{"speed", {"rpm"}}}}));
  data.columns.push_back({"speed_rpm", Role::speed, std::vector<double>(data.time_s.size(), 6000.0)});
  const Detectability constant = detectable(preflight(model, data), "speed_heating");
  EXPECT_EQ(constant.testability, Testability::input_constant);
  EXPECT_EQ(constant.deficiency, Deficiency{});
  data.columns.back().values[700] = std::nan("");
  const Detectability gap = detectable(preflight(model, data), "speed_heating");
  EXPECT_EQ(gap.testability, Testability::input_constant);
  EXPECT_TRUE(gap.deficiency.has_gaps);
  EXPECT_EQ(preflight(model, data).noise_source, NoiseSource::target);
  model.terms = {term_of(*find_effect("linear_drift", Level::series), {})};
  const Preflight with_drift = preflight(model, data);
  EXPECT_EQ(detectable(with_drift, "linear_drift").testability, Testability::in_the_model);
  EXPECT_EQ(with_drift.noise_source, NoiseSource::residual);
}

// Rows 8 minutes apart do not show a thermostat of 15 minutes.
TEST(Identifiability, rows_too_far_apart) {
  Model model;
  model.targets = {"y_um"};
  Series data = day();
  for (double& time_s : data.time_s) time_s *= 8.0;
  const Preflight found = preflight(model, data);
  const auto far = std::find_if(found.detectability.begin(), found.detectability.end(), [](const Detectability& one) {
    return one.testability == Testability::rows_too_far_apart;
  });
  ASSERT_NE(far, found.detectability.end());
  EXPECT_DOUBLE_EQ(far->deficiency.step_s, 480.0);
  EXPECT_DOUBLE_EQ(far->deficiency.period_s, 900.0);
}

}  // namespace
}  // namespace ballbar
