#include "ballbar/diagnosis/signatures/identifiability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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

}  // namespace
}  // namespace ballbar
