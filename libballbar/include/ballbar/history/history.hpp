// The history of a machine: each quantity over its tests, what changed, where it goes and when it meets its tolerance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/history/machine_geometry.hpp"
#include "ballbar/history/machine_test.hpp"
#include "ballbar/history/test_groups.hpp"
#include "ballbar/history/tolerance_date.hpp"
#include "ballbar/history/trend.hpp"

namespace ballbar {

// From the last test but one to the last of a group.
struct QuantityChange {
  std::int64_t since_s = 0;
  double value = 0.0;
  double sigma = 0.0;        // sqrt(s1^2 + s2^2); NaN: one of both has none
  bool significant = false;  // |value| > kSignificantSigmas sigma
};

struct QuantityHistory {
  std::string name, unit;
  bool of_set_up = false;          // then without change, trend and tolerance
  std::vector<std::size_t> tests;  // with a date, by date; those that do not determine it (sigma infinite) left out
  double last_value = 0.0;
  double last_sigma = 0.0;
  bool significant = false;  // the last value: its error is, and it is beyond kSignificantSigmas
  std::optional<QuantityChange> change;
  std::optional<Trend> trend;
  std::optional<Tolerance> tolerance;
  std::optional<ToleranceDate> date;  // where there is a tolerance
};

struct GroupHistory {
  TestGroup group;
  std::vector<QuantityHistory> quantities;  // in the order of the newest test
};

struct MachineHistory {
  std::string machine;  // empty: no test names one
  std::vector<GroupHistory> groups;
  MachineGeometry geometry;  // places in the tests given
  std::size_t changes = 0;   // that could be judged
  std::size_t trends = 0;
};

// One a machine that the tests name; those without a name belong to the only one, or make one of their own.
// `tolerances` go before those that the newest test of a group states. O(n log n) in tests.
std::vector<MachineHistory> history_of(std::span<const MachineTest> tests, std::span<const Tolerance> tolerances = {});

}  // namespace ballbar
