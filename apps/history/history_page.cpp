#include "history/history_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "history/conclusion.hpp"
#include "history/geometry_text.hpp"
#include "history/quantity_text.hpp"
#include "page/report_page.hpp"
#include "terminal/json_number.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMean_year_s = 365.2425 * 86400.0;

double year_of(double time_s) { return 1970.0 + time_s / kMean_year_s; }

// From the first test to a quarter of that time after the last, or to where the tolerance is met.
Json trend_json(const QuantityHistory& quantity, double first_s) {
  const Trend& trend = *quantity.trend;
  double end_s = trend.last_s + 0.25 * (trend.last_s - first_s);
  if (quantity.date && quantity.date->at_s)
    end_s = std::max(end_s, quantity.date->latest_s.value_or(*quantity.date->at_s));
  constexpr int kPoints = 32;
  Json years = Json::array(), values = Json::array(), sigmas = Json::array();
  for (int i = 0; i < kPoints; ++i) {
    const double time_s = first_s + (end_s - first_s) * i / (kPoints - 1);
    const double low = quantile(trend, time_s, 0.1587), high = quantile(trend, time_s, 0.8413);
    years.push_back(number(year_of(time_s)));
    values.push_back(number(0.5 * (low + high)));
    sigmas.push_back(number(0.5 * (high - low)));
  }
  return {{"year", years}, {"values", values}, {"sigmas", sigmas}};
}

Json quantity_json(const QuantityHistory& history, const std::vector<MachineTest>& tests) {
  Json years = Json::array(), values = Json::array(), sigmas = Json::array();
  for (const std::size_t i : history.tests) {
    const auto found = std::find_if(tests[i].quantities.begin(), tests[i].quantities.end(),
                                    [&](const TestQuantity& one) { return one.name == history.name; });
    if (found == tests[i].quantities.end()) continue;
    years.push_back(number(year_of(static_cast<double>(*tests[i].started_s))));
    values.push_back(number(found->value));
    sigmas.push_back(number(found->sigma));
  }
  Json json{{"name", history.name}, {"unit", history.unit}, {"year", years}, {"values", values}, {"sigmas", sigmas}};
  if (history.trend) {
    json["trend"] = trend_json(history, static_cast<double>(*tests[history.tests.front()].started_s));
  }
  if (history.tolerance && history.tolerance->lower) json["lower"] = *history.tolerance->lower;
  if (history.tolerance && history.tolerance->upper) json["upper"] = *history.tolerance->upper;
  return json;
}

// What to look at first: what meets its tolerance, what changed most, what has a trend.
double weight_of(const QuantityHistory& quantity) {
  if (quantity.date && (quantity.date->outlook == Outlook::beyond || quantity.date->outlook == Outlook::expected)) {
    return 3e6;
  }
  if (quantity.change && quantity.change->significant) {
    return 1e3 + std::min(1e5, std::abs(quantity.change->value) / std::max(quantity.change->sigma, 1e-12));
  }
  return quantity.trend && quantity.trend->significant ? 1e2 : quantity.name == "circularity" ? 1.0 : 0.0;
}

Json group_json(const std::string& machine, const GroupHistory& history, const std::vector<MachineTest>& tests) {
  Json json{{"label", (machine.empty() ? "" : machine + ": ") + group_text(history.group)},
            {"first", ""},
            {"quantities", Json::array()},
            {"heading", {"quantity", "unit", "last", "change", "sigmas", "a year", "tolerance", "met"}},
            {"rows", Json::array()}};
  double most = -1.0;
  for (const QuantityHistory& quantity : history.quantities) {
    if (quantity.of_set_up) continue;
    json["rows"].push_back({quantity.name, quantity.unit,
                            with_sigma(quantity.last_value, quantity.last_sigma, decimals_of(quantity.unit)),
                            change_text(quantity), sigmas_text(quantity), trend_text(quantity),
                            tolerance_text(quantity), met_text(quantity)});
    if (quantity.tests.empty()) continue;
    json["quantities"].push_back(quantity_json(quantity, tests));
    if (weight_of(quantity) <= most) continue;
    most = weight_of(quantity);
    json["first"] = quantity.name;
  }
  return json;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace

std::string history_page(const std::string& title, const TestFiles& files,
                         const std::vector<MachineHistory>& machines) {
  Json report{{"format", "ballbar-report 1"}, {"title", title},         {"made_by", "ballbar " BALLBAR_VERSION},
              {"made_on", page_date()},       {"files", Json::array()}, {"summary", Json::array()},
              {"signals", Json::array()}};
  for (const std::filesystem::path& file : files.files) report["files"].push_back(file.string());
  Json part{{"groups", Json::array()}, {"geometry", Json::array()}, {"geometry_rows", Json::array()}};
  for (const MachineHistory& machine : machines) {
    for (const std::string& line : lines_of(conclusion(machine))) report["summary"].push_back(line);
    for (const GroupHistory& group : machine.groups) {
      part["groups"].push_back(group_json(machine.machine, group, files.tests));
    }
    const GeometryTexts texts = geometry_texts(files, machine.geometry);
    for (const std::string& sentence : texts.sentences) part["geometry"].push_back(sentence);
    for (const auto& row : texts.rows) part["geometry_rows"].push_back(row);
  }
  part["skipped"] = Json::array();
  for (const SkippedTest& test : files.skipped) part["skipped"].push_back(test.sentence);
  report["history"] = std::move(part);
  return page_of(report, nullptr);
}

}  // namespace ballbar
