#include "history/history_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "history/conclusion.hpp"
#include "history/geometry_text.hpp"
#include "history/page_parts.hpp"
#include "history/quantity_text.hpp"
#include "page/report_page.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kMean_year_s = 365.2425 * 86400.0;

double year_of(double time_s) { return 1970.0 + time_s / kMean_year_s; }

// From the first test to a quarter of that time after the last, or to where the tolerance is met.
CurveOverYears trend_curve(const QuantityHistory& quantity, double first_s) {
  const Trend& trend = *quantity.trend;
  double end_s = trend.last_s + 0.25 * (trend.last_s - first_s);
  if (quantity.date && quantity.date->at_s)
    end_s = std::max(end_s, quantity.date->latest_s.value_or(*quantity.date->at_s));
  constexpr int kPoints = 32;
  CurveOverYears curve;
  for (int i = 0; i < kPoints; ++i) {
    const double time_s = first_s + (end_s - first_s) * i / (kPoints - 1);
    const double low = quantile(trend, time_s, 0.1587), high = quantile(trend, time_s, 0.8413);
    curve.year.push_back(year_of(time_s));
    curve.values.push_back(0.5 * (low + high));
    curve.sigmas.push_back(0.5 * (high - low));
  }
  return curve;
}

DrawnQuantity drawn(const QuantityHistory& history, const std::vector<MachineTest>& tests) {
  DrawnQuantity quantity{history.name, history.unit, {}, {}, {}, {}, {}};
  for (const std::size_t i : history.tests) {
    const auto found = std::find_if(tests[i].quantities.begin(), tests[i].quantities.end(),
                                    [&](const TestQuantity& one) { return one.name == history.name; });
    if (found == tests[i].quantities.end()) continue;
    quantity.tests.year.push_back(year_of(static_cast<double>(*tests[i].started_s)));
    quantity.tests.values.push_back(found->value);
    quantity.tests.sigmas.push_back(found->sigma);
  }
  if (history.trend)
    quantity.trend.value = trend_curve(history, static_cast<double>(*tests[history.tests.front()].started_s));
  if (history.tolerance) {
    quantity.lower.value = history.tolerance->lower;
    quantity.upper.value = history.tolerance->upper;
  }
  return quantity;
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

DrawnGroup drawn(const std::string& machine, const GroupHistory& history, const std::vector<MachineTest>& tests) {
  DrawnGroup group{(machine.empty() ? "" : machine + ": ") + group_text(history.group),
                   "",
                   {},
                   {"quantity", "unit", "last", "change", "sigmas", "a year", "tolerance", "met"},
                   {}};
  double most = -1.0;
  for (const QuantityHistory& quantity : history.quantities) {
    if (quantity.of_set_up) continue;
    group.rows.push_back({quantity.name, quantity.unit,
                          with_sigma(quantity.last_value, quantity.last_sigma, decimals_of(quantity.unit)),
                          change_text(quantity), sigmas_text(quantity), trend_text(quantity), tolerance_text(quantity),
                          met_text(quantity)});
    if (quantity.tests.empty()) continue;
    group.quantities.push_back(drawn(quantity, tests));
    if (weight_of(quantity) <= most) continue;
    most = weight_of(quantity);
    group.first = quantity.name;
  }
  return group;
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
  HistoryReport report{report_head(title), {}};
  for (const std::filesystem::path& file : files.files) report.head.files.push_back(file.string());
  HistoryPart& part = report.history;
  for (const MachineHistory& machine : machines) {
    for (const std::string& line : lines_of(conclusion(machine))) report.head.summary.push_back(line);
    for (const GroupHistory& group : machine.groups) part.groups.push_back(drawn(machine.machine, group, files.tests));
    const GeometryTexts texts = geometry_texts(files, machine.geometry);
    part.geometry.insert(part.geometry.end(), texts.sentences.begin(), texts.sentences.end());
    part.geometry_rows.insert(part.geometry_rows.end(), texts.rows.begin(), texts.rows.end());
  }
  for (const SkippedTest& test : files.skipped) part.skipped.push_back(test.sentence);
  return page_of(json_of(report), nullptr);
}

}  // namespace ballbar
