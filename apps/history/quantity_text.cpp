#include "history/quantity_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

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
  if (!group.bar.empty()) text += ", bar " + group.bar;
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

std::string value_text(const QuantityHistory& quantity) {
  return fmt::format("{} {} {}", quantity.name,
                     with_sigma(quantity.last_value, quantity.last_sigma, decimals_of(quantity.unit)), quantity.unit);
}

}  // namespace ballbar
