#include "errors/test_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "errors/quantity_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// In quotes where it needs them.
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

// Empty: not finite.
std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string optional_cell(const std::optional<double>& value) { return value ? csv_number(*value) : ""; }

bool has_tolerance(const std::vector<MachineTest>& tests) {
  return std::any_of(tests.begin(), tests.end(), [](const MachineTest& one) { return one.passes.has_value(); });
}

bool states_machine(const std::vector<MachineTest>& tests) {
  return std::any_of(tests.begin(), tests.end(), [](const MachineTest& one) { return !one.machine.empty(); });
}

// "3 of 7 fail the tolerance of 6 um.", "All 7 pass the tolerance of 6 um."
std::string tolerance_text(const TestFiles& files) {
  std::size_t fail = 0, unknown = 0;
  bool by_limits = false;
  for (const MachineTest& test : files.tests) {
    if (!test.passes) ++unknown;
    if (test.passes == false) ++fail;
    by_limits = by_limits || !test.beyond_limits.empty();
  }
  const std::size_t all = files.tests.size();
  std::string text = fail > 0
                         ? fmt::format("{} of {} fail{} the tolerance of {:g} um{}.", fail, all, fail == 1 ? "s" : "",
                                       *files.tolerance_um, by_limits ? " or a limit in the file" : "")
                         : fmt::format("{} of {} pass{} the tolerance of {:g} um.", all - unknown, all,
                                       all - unknown == 1 ? "es" : "", *files.tolerance_um);
  if (unknown > 0)
    text += fmt::format(" {} no circularity.", unknown == 1 ? "1 test has" : fmt::format("{} tests have", unknown));
  return text + "\n";
}

// What is compared, and the stored results that fail a limit.
std::string checks_text(const TestFiles& files, std::size_t most) {
  std::string text = "\n" + wrapped(
                                "Circularity: largest less smallest reading of a test about the fitted centre; stored: "
                                "AF_CIRCULARITY in a file without readings.");
  std::size_t beyond = 0;
  for (const MachineTest& test : files.tests) {
    if (test.beyond_limits.empty() || ++beyond > most) continue;
    text += wrapped(fmt::format("{}: stored {}: fail{} the limit in the file.", one_line(test.file),
                                fmt::join(test.beyond_limits, ", "), test.beyond_limits.size() == 1 ? "s" : ""));
  }
  return beyond > most ? text + more_text(beyond - most, "test") + "\n" : text;
}

std::string circularity_cell(const MachineTest& test) {
  const TestQuantity* const round = quantity_of(test, "circularity");
  if (round == nullptr) return "-";
  return test.stored ? fixed(round->value, 2) + " stored" : with_sigma(round->value, round->sigma, 2);
}

std::string heading_text(const TestFiles& files) {
  std::set<std::string> machines;
  for (const MachineTest& test : files.tests) machines.insert(test.machine);
  std::string text = several(files.tests.size(), "test");
  if (machines.size() > 1) text += fmt::format(" of {} machines", machines.size());
  if (const std::string dates = dates_text(files.tests); !dates.empty()) text += ", " + dates;
  return text + "\n";
}

}  // namespace

std::string dates_text(const std::vector<MachineTest>& tests) {
  std::string first, last;
  for (const MachineTest& test : tests) {
    if (!test.started_s) continue;
    const std::string date = date_text(static_cast<double>(*test.started_s));
    if (first.empty() || date < first) first = date;
    last = std::max(last, date);
  }
  return first == last ? first : fmt::format("{} to {}", first, last);
}

const TestQuantity* quantity_of(const MachineTest& test, std::string_view name) {
  const auto found =
      std::find_if(test.quantities.begin(), test.quantities.end(), [&](const auto& one) { return one.name == name; });
  return found == test.quantities.end() ? nullptr : &*found;
}

const TestQuantity* first_to_mend(const MachineTest& test) {
  const TestQuantity* found = nullptr;
  for (const TestQuantity& one : test.quantities) {
    if (one.rank != std::size_t{1}) continue;
    if (found == nullptr || std::abs(one.value) > std::abs(found->value)) found = &one;
  }
  return found;
}

std::string column_name(const TestQuantity& quantity, bool of_sigma) {
  std::string unit = quantity.unit;
  if (const std::size_t slash = unit.find('/'); slash != std::string::npos) unit.replace(slash, 1, "_per_");
  return fmt::format("{}{}_{}", quantity.name, of_sigma ? "_sigma" : "", unit);
}

std::string test_table_csv(const std::vector<MachineTest>& tests) {
  std::vector<std::string> names;
  std::map<std::string, std::size_t> place;
  for (const MachineTest& test : tests) {
    for (const TestQuantity& one : test.quantities) {
      if (!place.emplace(column_name(one), names.size()).second) continue;
      names.push_back(column_name(one));
      names.push_back(column_name(one, true));
    }
  }
  const bool with_tolerance = has_tolerance(tests);
  std::string text = "file,machine,bar,date,plane,length_mm,feed_mm_per_min,start_deg,arc_deg,stored";
  if (with_tolerance) text += ",passes";
  for (const std::string& name : names) text += ',' + name;
  text += '\n';
  for (const MachineTest& test : tests) {
    std::vector<std::string> cells(names.size());
    for (const TestQuantity& one : test.quantities) {
      const std::size_t at = place.at(column_name(one));
      cells[at] = csv_number(one.value);
      cells[at + 1] = csv_number(one.sigma);
    }
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}", csv_text(test.file), csv_text(test.machine),
                        csv_text(test.bar), test.started_s ? iso_date_text(*test.started_s) : "", name_of(test.plane),
                        csv_number(test.nominal_length_mm), optional_cell(test.feed_mm_per_min),
                        csv_number(test.start_deg), csv_number(test.arc_deg), test.stored ? 1 : 0);
    if (with_tolerance) text += !test.passes ? "," : *test.passes ? ",1" : ",0";
    for (const std::string& cell : cells) text += ',' + cell;
    text += '\n';
  }
  return text;
}

std::string test_table_text(const TestFiles& files, bool details) {
  constexpr std::size_t kRows = 30, kSkipped = 5;
  std::string text = heading_text(files) + "\n";
  if (files.tolerance_um) text += tolerance_text(files) + "\n";
  const bool with_machine = states_machine(files.tests);
  std::vector<std::string> heading{"file", "date"};
  if (with_machine) heading.emplace_back("machine");
  heading.insert(heading.end(), {"plane", "mm/min", "circularity um"});
  if (files.tolerance_um) heading.emplace_back("tolerance");
  heading.insert(heading.end(), {"main error", "", ""});
  Table table(heading);
  for (const MachineTest& test : files.tests) {
    std::vector<std::string> row{one_line(test.file),
                                 test.started_s ? date_text(static_cast<double>(*test.started_s)) : "-"};
    if (with_machine) row.push_back(test.machine.empty() ? "-" : one_line(test.machine));
    row.insert(row.end(),
               {std::string(name_of(test.plane)),
                test.feed_mm_per_min ? fmt::format("{:.0f}", *test.feed_mm_per_min) : "-", circularity_cell(test)});
    if (files.tolerance_um) row.emplace_back(!test.passes ? "-" : *test.passes ? "pass" : "fail");
    if (const TestQuantity* const first = first_to_mend(test)) {
      row.insert(
          row.end(),
          {first->name, test.stored ? fixed(first->value, 2) : with_sigma(first->value, first->sigma, 2), first->unit});
    } else {
      row.insert(row.end(), {test.stored ? "not in the file" : "none", "", ""});
    }
    table.add(row);
  }
  if (!details) table.shorten(kRows);
  text += table.text();
  if (files.tolerance_um) text += checks_text(files, details ? files.tests.size() : kSkipped);
  const std::size_t shown = details ? files.skipped.size() : std::min(kSkipped, files.skipped.size());
  for (std::size_t i = 0; i < shown; ++i) text += "\n" + wrapped(files.skipped[i].sentence);
  if (shown < files.skipped.size()) text += more_text(files.skipped.size() - shown, "skipped file") + "\n";
  return text;
}

}  // namespace ballbar
