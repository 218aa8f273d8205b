#include "errors/test_table.hpp"

#include <fmt/format.h>

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

const TestQuantity* quantity_of(const MachineTest& test, std::string_view name) {
  const auto found =
      std::find_if(test.quantities.begin(), test.quantities.end(), [&](const auto& one) { return one.name == name; });
  return found == test.quantities.end() ? nullptr : &*found;
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
  std::string text = "file,machine,bar,date,plane,length_mm,feed_mm_per_min,start_deg,arc_deg,stored";
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
    for (const std::string& cell : cells) text += ',' + cell;
    text += '\n';
  }
  return text;
}

std::string test_table_text(const TestFiles& files, bool details) {
  constexpr std::size_t kRows = 30, kSkipped = 5;
  std::string text = heading_text(files) + "\n";
  Table table({"file", "date", "machine", "plane", "mm/min", "circularity um", "main error", "", ""});
  for (const MachineTest& test : files.tests) {
    const TestQuantity* const round = quantity_of(test, "circularity");
    const TestQuantity* const first = first_to_mend(test);
    table.add({one_line(test.file), test.started_s ? date_text(static_cast<double>(*test.started_s)) : "-",
               test.machine.empty() ? "-" : one_line(test.machine), std::string(name_of(test.plane)),
               test.feed_mm_per_min ? fmt::format("{:.0f}", *test.feed_mm_per_min) : "-",
               round == nullptr ? "-" : with_sigma(round->value, round->sigma, 2),
               first == nullptr ? "none" : first->name,
               first == nullptr ? "" : with_sigma(first->value, first->sigma, 2), first == nullptr ? "" : first->unit});
  }
  if (!details) table.shorten(kRows);
  text += table.text();
  const std::size_t shown = details ? files.skipped.size() : std::min(kSkipped, files.skipped.size());
  for (std::size_t i = 0; i < shown; ++i) text += "\n" + wrapped(files.skipped[i].sentence);
  if (shown < files.skipped.size()) text += more_text(files.skipped.size() - shown, "skipped file") + "\n";
  return text;
}

}  // namespace ballbar
