#include "ballbar/history/history.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ballbar/numerics/parallel.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

struct QuantityInTest {
  std::size_t test = 0;
  const TestQuantity* quantity = nullptr;
};

const Tolerance* tolerance_of(std::string_view quantity, std::span<const Tolerance> tolerances) {
  for (const Tolerance& tolerance : tolerances) {
    if (tolerance.quantity == quantity) return &tolerance;
  }
  return nullptr;
}

// `values`: by date.
QuantityHistory history_of_quantity(std::span<const MachineTest> tests, const std::vector<QuantityInTest>& values,
                                    std::span<const Tolerance> tolerances) {
  const TestQuantity& last = *values.back().quantity;
  QuantityHistory history;
  history.name = last.name;
  history.unit = last.unit;
  history.of_set_up = last.of_set_up;
  history.last_value = last.value;
  history.last_sigma = last.sigma;
  history.significant = last.significant && std::abs(last.value) > kSignificantSigmas * last.sigma;
  std::vector<DatedValue> dated;
  dated.reserve(values.size());
  for (const auto& [test, quantity] : values) {
    if (!tests[test].started_s || std::isinf(quantity->sigma)) continue;  // undetermined: it says nothing
    history.tests.push_back(test);
    dated.push_back({static_cast<double>(*tests[test].started_s), quantity->value, quantity->sigma});
  }
  if (history.of_set_up) return history;
  if (dated.size() > 1) {
    const DatedValue& now = dated.back();
    const DatedValue& before = dated[dated.size() - 2];
    QuantityChange change;
    change.since_s = *tests[history.tests[history.tests.size() - 2]].started_s;
    change.value = now.value - before.value;
    change.sigma = std::hypot(now.sigma, before.sigma);
    change.significant = std::abs(change.value) > kSignificantSigmas * change.sigma;
    history.change = change;
  }
  history.trend = trend_of(dated);
  const Tolerance* tolerance = tolerance_of(history.name, tolerances);
  if (tolerance == nullptr) tolerance = tolerance_of(history.name, tests[values.back().test].tolerances);
  if (tolerance != nullptr) {
    history.tolerance = *tolerance;
    history.date = tolerance_date(*tolerance, history.last_value, history.trend);
  }
  return history;
}

GroupHistory history_of_group(std::span<const MachineTest> tests, TestGroup group,
                              std::span<const Tolerance> tolerances) {
  std::map<std::string_view, std::vector<QuantityInTest>> by_name;
  std::vector<std::string_view> names;
  // From the newest test: its quantities stand first, in its order.
  for (auto test = group.tests.rbegin(); test != group.tests.rend(); ++test) {
    for (const TestQuantity& quantity : tests[*test].quantities) {
      std::vector<QuantityInTest>& values = by_name[quantity.name];
      if (values.empty()) names.push_back(quantity.name);
      values.push_back({*test, &quantity});
    }
  }
  GroupHistory history;
  history.group = std::move(group);
  history.quantities.reserve(names.size());
  for (const std::string_view name : names) {
    std::vector<QuantityInTest>& values = by_name[name];
    std::reverse(values.begin(), values.end());
    history.quantities.push_back(history_of_quantity(tests, values, tolerances));
  }
  return history;
}

MachineHistory history_of_machine(std::span<const MachineTest> tests, std::span<const Tolerance> tolerances) {
  MachineHistory history;
  std::vector<TestGroup> groups = groups_of(tests);
  history.groups.resize(groups.size());
  in_parallel(groups.size(),
              [&](std::size_t i) { history.groups[i] = history_of_group(tests, std::move(groups[i]), tolerances); });
  for (const GroupHistory& group : history.groups) {
    for (const QuantityHistory& quantity : group.quantities) {
      if (quantity.change && std::isfinite(quantity.change->sigma)) ++history.changes;
      if (quantity.trend) ++history.trends;
    }
  }
  history.geometry = machine_geometry(tests);
  return history;
}

// Places among the tests of one machine, as places among all.
void number_by(const std::vector<std::size_t>& places, std::vector<std::size_t>& tests) {
  for (std::size_t& test : tests) test = places[test];
}

void number_by(const std::vector<std::size_t>& places, MachineHistory& history) {
  for (GroupHistory& group : history.groups) {
    number_by(places, group.group.tests);
    for (QuantityHistory& quantity : group.quantities) number_by(places, quantity.tests);
  }
  number_by(places, history.geometry.tests);
  for (PlaneSquareness& plane : history.geometry.squareness) number_by(places, plane.tests);
  for (ScalePull& pull : history.geometry.pulls) pull.test = places[pull.test];
}

}  // namespace

std::vector<MachineHistory> history_of(std::span<const MachineTest> tests, std::span<const Tolerance> tolerances) {
  std::set<std::string> machines;
  for (const MachineTest& test : tests) {
    if (!test.machine.empty()) machines.insert(test.machine);
  }
  const std::string unnamed = machines.size() == 1 ? *machines.begin() : "";
  std::map<std::string, std::vector<std::size_t>> of_machine;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    of_machine[tests[i].machine.empty() ? unnamed : tests[i].machine].push_back(i);
  }
  std::vector<MachineHistory> histories;
  histories.reserve(of_machine.size());
  for (const auto& [machine, places] : of_machine) {
    std::vector<MachineTest> own;
    own.reserve(places.size());
    for (const std::size_t place : places) own.push_back(tests[place]);
    histories.push_back(history_of_machine(own, tolerances));
    histories.back().machine = machine;
    number_by(places, histories.back());
  }
  return histories;
}

}  // namespace ballbar
