#include "history/history_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "history/geometry_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kByChance = 0.0093;  // beyond 2.6 sigmas

int decimals_of(const std::string& unit) { return unit == "ms" ? 3 : unit == "um" ? 2 : 1; }

std::string signed_text(double value, int decimals) {
  const std::string text = fixed(value, decimals);
  return text.starts_with('-') ? text : '+' + text;
}

std::string change_text(const QuantityHistory& quantity) {
  if (!quantity.change) return "-";
  const QuantityChange& change = *quantity.change;
  return signed_text(change.value, decimals_of(quantity.unit)) + (change.significant ? " *" : "");
}

std::string sigmas_text(const QuantityHistory& quantity) {
  if (!quantity.change || !std::isfinite(quantity.change->sigma)) return "-";
  const double sigmas = std::abs(quantity.change->value) / quantity.change->sigma;
  return std::isfinite(sigmas) ? fmt::format("{:.1f}", sigmas) : "-";
}

std::string trend_text(const QuantityHistory& quantity) {
  if (!quantity.trend) return "-";
  return with_sigma(quantity.trend->rate_per_year, quantity.trend->sigma_per_year, decimals_of(quantity.unit)) +
         (quantity.trend->significant ? " *" : "");
}

std::string tolerance_text(const QuantityHistory& quantity) {
  if (!quantity.tolerance) return "-";
  const auto& [name, lower, upper] = *quantity.tolerance;
  if (lower && upper && *lower == -*upper) return fmt::format("± {:g}", *upper);
  if (lower && upper) return fmt::format("{:g} to {:g}", *lower, *upper);
  return lower ? fmt::format("from {:g}", *lower) : fmt::format("to {:g}", upper.value_or(0.0));
}

// "2027-03-01 (2026-11-05 to 2027-10-20)".
std::string expected_text(const ToleranceDate& date) {
  return fmt::format("{} ({} to {})", date_text(*date.at_s), date_text(*date.earliest_s),
                     date.latest_s ? date_text(*date.latest_s) : "open");
}

std::string met_text(const QuantityHistory& quantity) {
  if (!quantity.date) return "-";
  switch (quantity.date->outlook) {
    case Outlook::beyond:
      return "beyond it";
    case Outlook::no_trend:
      return "no trend";
    case Outlook::away:
      return fmt::format("not within {:g} years", kForecast_years);
    case Outlook::expected:
      return expected_text(*quantity.date);
  }
  return "-";
}

bool is_a_date(const QuantityHistory& quantity, Outlook outlook) {
  return quantity.date && quantity.date->outlook == outlook;
}

// Whether its row is shown without --all.
bool says_something(const QuantityHistory& quantity, const std::string& squareness) {
  if (quantity.of_set_up) return false;
  if (quantity.name == "circularity" || quantity.name == "residual_rms" || quantity.name == squareness) return true;
  if (quantity.tolerance || (quantity.change && quantity.change->significant)) return true;
  if (quantity.trend && quantity.trend->significant) return true;
  return std::abs(quantity.last_value) > kSignificantSigmas * quantity.last_sigma;
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

std::string several(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string group_table(const TestFiles& files, const GroupHistory& history, bool all) {
  const std::vector<std::size_t>& places = history.group.tests;
  const MachineTest& newest = files.tests[places.back()];
  const std::string squareness = newest.squareness ? newest.squareness->name : "";
  const auto stored = static_cast<std::size_t>(
      std::count_if(places.begin(), places.end(), [&](std::size_t i) { return files.tests[i].stored; }));
  std::string text = fmt::format(
      "{}; {}, {}{}\n", group_text(history.group), several(places.size(), "test"), first_and_last(files.tests, places),
      stored == 0 ? "" : fmt::format("; {} stored value{} without readings", stored, stored == 1 ? "s of one" : "s"));
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

struct Told {
  const GroupHistory* group = nullptr;
  const QuantityHistory* quantity = nullptr;
};

// Every quantity of the machine for which `tells` holds.
template <class Tells>
std::vector<Told> those(const MachineHistory& machine, const Tells& tells) {
  std::vector<Told> found;
  for (const GroupHistory& group : machine.groups) {
    for (const QuantityHistory& quantity : group.quantities) {
      if (tells(quantity)) found.push_back({&group, &quantity});
    }
  }
  return found;
}

// At most so many lines, then how many more.
template <class Line>
std::string lines_of(const std::vector<Told>& found, const Line& line) {
  constexpr std::size_t kMost = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, found.size()); ++i) {
    text += fmt::format("  {}: {}\n", group_text(found[i].group->group), line(*found[i].quantity));
  }
  if (found.size() > kMost) text += fmt::format("  and {} more, marked below\n", found.size() - kMost);
  return text;
}

std::string value_text(const QuantityHistory& quantity) {
  return fmt::format("{} {} {}", quantity.name,
                     with_sigma(quantity.last_value, quantity.last_sigma, decimals_of(quantity.unit)), quantity.unit);
}

double sigmas_of(const QuantityHistory& quantity) {
  return std::abs(quantity.change->value) / std::max(quantity.change->sigma, 1e-12);
}

std::string changed_lines(const MachineHistory& machine) {
  auto changed = those(machine, [](const QuantityHistory& one) { return one.change && one.change->significant; });
  std::stable_sort(changed.begin(), changed.end(), [](const Told& left, const Told& right) {
    return sigmas_of(*left.quantity) > sigmas_of(*right.quantity);
  });
  if (changed.empty()) {
    if (machine.changes == 0) return "Nothing to compare: no test was repeated.\n";
    return fmt::format("Nothing changed since the test before by more than {:g} of both sigmas.\n", kSignificantSigmas);
  }
  return fmt::format("Changed since the test before, by more than {:g} of both sigmas:\n", kSignificantSigmas) +
         lines_of(changed, [](const QuantityHistory& one) {
           const int decimals = decimals_of(one.unit);
           return fmt::format("{}, {} ± {} since {}", value_text(one), signed_text(one.change->value, decimals),
                              fixed(one.change->sigma, decimals), date_text(static_cast<double>(one.change->since_s)));
         });
}

std::string tolerance_lines(const MachineHistory& machine) {
  const auto beyond = those(machine, [](const QuantityHistory& one) { return is_a_date(one, Outlook::beyond); });
  auto expected = those(machine, [](const QuantityHistory& one) { return is_a_date(one, Outlook::expected); });
  std::stable_sort(expected.begin(), expected.end(), [](const Told& left, const Told& right) {
    return *left.quantity->date->at_s < *right.quantity->date->at_s;
  });
  std::string text;
  if (!beyond.empty()) {
    text += "Beyond its tolerance:\n" + lines_of(beyond, [](const QuantityHistory& one) {
              return fmt::format("{}, tolerance {}", value_text(one), tolerance_text(one));
            });
  }
  if (!expected.empty()) {
    text += "Meets its tolerance if the trend goes on (95 % interval):\n" +
            lines_of(expected, [](const QuantityHistory& one) {
              return fmt::format("{}, tolerance {}: {}", one.name, tolerance_text(one), expected_text(*one.date));
            });
  }
  return text;
}

std::string trend_lines(const MachineHistory& machine) {
  if (machine.trends == 0) {
    return wrapped(fmt::format("No trend to tell: it takes {} tests of a group over more than a week.", kTestsOfTrend));
  }
  const auto trends = those(machine, [](const QuantityHistory& one) {
    return one.trend && one.trend->significant && !is_a_date(one, Outlook::expected);
  });
  if (trends.empty()) return "";
  return "Trend:\n" + lines_of(trends, [](const QuantityHistory& one) {
           return fmt::format("{} {} {} a year", one.name,
                              with_sigma(one.trend->rate_per_year, one.trend->sigma_per_year, decimals_of(one.unit)),
                              one.unit);
         });
}

std::string conclusion(const MachineHistory& machine) {
  std::string text = changed_lines(machine) + tolerance_lines(machine) + trend_lines(machine);
  const std::size_t judged = machine.changes + machine.trends;
  if (judged > 0) {
    text += wrapped(fmt::format("{} and {} were judged; {:.1f} of them exceed {:g} sigmas by chance.",
                                several(machine.changes, "change"), several(machine.trends, "trend"),
                                kByChance * static_cast<double>(judged), kSignificantSigmas));
  }
  return text;
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

std::string date_text(double time_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(std::floor(time_s))));
}

std::string iso_date_text(std::int64_t time_s) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(time_s)));
}

std::string group_text(const TestGroup& group) {
  std::string text = fmt::format("{}, {:g} mm", name_of(group.plane), group.nominal_length_mm);
  if (group.feed_mm_per_min) text += fmt::format(", {:.0f} mm/min", *group.feed_mm_per_min);
  text += fmt::format(", {:.0f} deg", group.arc_deg);
  if (group.arc_deg < 359.0) text += fmt::format(" from {:.0f}", group.start_deg);
  if (!group.bar.empty()) text += ", bar " + group.bar;
  return text;
}

std::string history_text(const TestFiles& files, const std::vector<MachineHistory>& machines, bool all) {
  std::string text;
  for (const MachineHistory& machine : machines) {
    const std::vector<std::size_t> places = tests_of(machine);
    text += fmt::format("{}{}, {}, {}\n\n", machine.machine.empty() ? "" : machine.machine + ": ",
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
  for (const SkippedFile& file : files.skipped) sentences.push_back(file.sentence);
  if (!sentences.empty()) {
    text += fmt::format("\nSkipped, {}:\n", several(sentences.size(), "file")) + list_text(sentences);
  }
  return text;
}

}  // namespace ballbar
