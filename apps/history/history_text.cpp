#include "history/history_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "history/conclusion.hpp"
#include "history/geometry_text.hpp"
#include "history/quantity_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// Whether its row is shown without --all.
bool says_something(const QuantityHistory& quantity, const std::string& squareness) {
  if (quantity.of_set_up) return false;
  if (quantity.name == "circularity" || quantity.name == "residual_rms" || quantity.name == squareness) return true;
  if (quantity.tolerance || (quantity.change && quantity.change->significant)) return true;
  if (quantity.trend && quantity.trend->significant) return true;
  if (quantity.name == "global_scale") return false;  // the scales of both axes hold it
  return quantity.significant || !std::isfinite(quantity.last_sigma);
}

std::string first_and_last(const std::vector<MachineTest>& tests, const std::vector<std::size_t>& places) {
  std::string first, last;
  for (const std::size_t i : places) {
    if (!tests[i].started_s) continue;
    const std::string date = date_text(static_cast<double>(*tests[i].started_s));
    if (first.empty() || date < first) first = date;
    last = std::max(last, date);
  }
  if (first.empty()) return "without a date";
  return first == last ? first : fmt::format("{} to {}", first, last);
}

std::string group_table(const TestFiles& files, const GroupHistory& history, bool all) {
  const std::vector<std::size_t>& places = history.group.tests;
  const MachineTest& newest = files.tests[places.back()];
  const std::string squareness = newest.squareness ? newest.squareness->name : "";
  const auto stored = static_cast<std::size_t>(
      std::count_if(places.begin(), places.end(), [&](std::size_t i) { return files.tests[i].stored; }));
  std::string text =
      fmt::format("{}; {}, {}{}\n", group_text(history.group), several(places.size(), "test"),
                  first_and_last(files.tests, places), stored == 0 ? "" : fmt::format(", {} of stored values", stored));
  const bool any_change = std::any_of(history.quantities.begin(), history.quantities.end(),
                                      [](const QuantityHistory& one) { return one.change.has_value(); });
  const bool any_trend = std::any_of(history.quantities.begin(), history.quantities.end(),
                                     [](const QuantityHistory& one) { return one.trend.has_value(); });
  const bool any_tolerance = std::any_of(history.quantities.begin(), history.quantities.end(),
                                         [](const QuantityHistory& one) { return one.tolerance.has_value(); });
  std::vector<std::string> heading{"quantity", "unit", "last"};
  if (any_change) heading.insert(heading.end(), {"change", "sigmas"});
  if (any_trend) heading.emplace_back("a year");
  if (any_tolerance) heading.insert(heading.end(), {"tolerance", "met"});
  Table table(heading);
  std::size_t left_out = 0;
  for (const QuantityHistory& quantity : history.quantities) {
    if (!all && !says_something(quantity, squareness)) {
      if (!quantity.of_set_up) ++left_out;
      continue;
    }
    std::vector<std::string> row{quantity.name, quantity.unit,
                                 with_sigma(quantity.last_value, quantity.last_sigma, decimals_of(quantity.unit))};
    if (any_change) row.insert(row.end(), {change_text(quantity), sigmas_text(quantity)});
    if (any_trend) row.push_back(trend_text(quantity));
    if (any_tolerance) row.insert(row.end(), {tolerance_text(quantity), met_text(quantity)});
    table.add(row);
  }
  text += table.text();
  if (left_out > 0) {
    text += fmt::format("{} more: not significant, unchanged, no trend (--all).\n", left_out);
  }
  return text + '\n';
}

std::vector<std::size_t> tests_of(const MachineHistory& machine) {
  std::vector<std::size_t> places;
  for (const GroupHistory& group : machine.groups) {
    places.insert(places.end(), group.group.tests.begin(), group.group.tests.end());
  }
  return places;
}

// Names of some, then how many more.
template <class Names>
std::string list_text(const Names& names) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i) text += "  " + names[i] + '\n';
  if (names.size() > kMost) text += fmt::format("  and {} more (all with --json)\n", names.size() - kMost);
  return text;
}

}  // namespace

std::string history_text(const TestFiles& files, const std::vector<MachineHistory>& machines, bool all) {
  std::string text;
  for (const MachineHistory& machine : machines) {
    const std::vector<std::size_t> places = tests_of(machine);
    text += fmt::format("{}{}, {}, {}\n\n", machine.machine.empty() ? "" : shortened(machine.machine, 80) + ": ",
                        several(places.size(), "test"), several(machine.groups.size(), "group"),
                        first_and_last(files.tests, places));
    text += conclusion(machine) + '\n';
    for (const GroupHistory& group : machine.groups) text += group_table(files, group, all);
    text += geometry_text(files, machine.geometry);
  }
  text += wrapped(
      "± is one sigma, of the fit or, of a trend, with the scatter of the tests about it; * more than 2.6 of them. "
      "Stored values have none (?). Change: since the test before of the group.");
  std::vector<std::string> undated;
  for (const MachineTest& test : files.tests) {
    if (!test.started_s) undated.push_back(test.file);
  }
  if (!undated.empty()) text += "\nWithout a date, in no change and no trend:\n" + list_text(undated);
  std::vector<std::string> sentences;
  sentences.reserve(files.skipped.size());
  for (const SkippedTest& file : files.skipped) sentences.push_back(file.sentence);
  if (!sentences.empty()) {
    text += fmt::format("\nSkipped, {}:\n", several(sentences.size(), "file")) + list_text(sentences);
  }
  return text;
}

}  // namespace ballbar
