#include "errors/quantity_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "terminal/terminal_table.hpp"

namespace ballbar {

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
  return text;
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string several(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

int decimals_of(const std::string& unit) { return unit == "ms" ? 3 : unit == "um" ? 2 : 1; }

std::string signed_text(double value, int decimals) {
  const std::string text = fixed(value, decimals);
  return text.starts_with('-') ? text : '+' + text;
}

std::string tolerance_text(const Tolerance& tolerance) {
  const auto& [name, lower, upper] = tolerance;
  if (lower && upper && *lower == -*upper) return fmt::format("± {:g}", *upper);
  if (lower && upper) return fmt::format("{:g} to {:g}", *lower, *upper);
  return lower ? fmt::format("from {:g}", *lower) : fmt::format("to {:g}", upper.value_or(0.0));
}

std::string outlook_text(const ToleranceOutlook& one) {
  const ToleranceDate& date = one.date;
  switch (date.outlook) {
    case Outlook::beyond:
      return "beyond it";
    case Outlook::no_trend:
      return one.last_alone ? "the last test alone beyond it" : "no trend";
    case Outlook::away:
      return fmt::format("not within {:g} years", kForecast_years);
    case Outlook::expected:
      return fmt::format("{} ({} to {})", date_text(*date.at_s), date_text(*date.earliest_s),
                         date.latest_s ? date_text(*date.latest_s) : "open");
  }
  return "-";
}

const ToleranceOutlook* outlook_for(const MachineHistory& machine, std::size_t series) {
  const auto found = std::find_if(machine.tolerances.begin(), machine.tolerances.end(),
                                  [&](const ToleranceOutlook& one) { return one.series == series; });
  return found == machine.tolerances.end() ? nullptr : &*found;
}

bool is_found(const MachineHistory& machine, std::size_t series, bool lasting) {
  return std::any_of(machine.findings.begin(), machine.findings.end(), [&](const Finding& finding) {
    if (finding.kind == FindingKind::season || (finding.kind == FindingKind::trend) != lasting) return false;
    return std::any_of(finding.quantities.begin(), finding.quantities.end(),
                       [&](const FindingQuantity& one) { return one.series == series; });
  });
}

std::string_view name_of(Outlook outlook) {
  switch (outlook) {
    case Outlook::beyond:
      return "beyond";
    case Outlook::no_trend:
      return "no_trend";
    case Outlook::away:
      return "not_within_10_years";
    case Outlook::expected:
      return "expected";
  }
  return "";
}

}  // namespace ballbar
