#include "history/history_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "errors/test_table.hpp"
#include "history/history_text.hpp"
#include "page/report_page.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kPictures = 40;  // machines that are drawn

double year_of(double time_s) { return 1970.0 + time_s / (365.2425 * 86400.0); }

// From the first value to a quarter of that time after the last, or to where the tolerance is met.
CurveOverYears trend_curve(const QuantityHistory& series, const ToleranceOutlook* outlook) {
  const double first_s = series.time_s[series.time_s.size() - series.trend->tests];
  double end_s = series.trend->last_s + 0.25 * (series.trend->last_s - first_s);
  if (outlook != nullptr && outlook->date.at_s)
    end_s = std::max(end_s, outlook->date.latest_s.value_or(*outlook->date.at_s));
  constexpr int kPoints = 32;
  CurveOverYears curve;
  for (int i = 0; i < kPoints; ++i) {
    const double time_s = first_s + (end_s - first_s) * i / (kPoints - 1);
    const double low = quantile(*series.trend, time_s, 0.1587), high = quantile(*series.trend, time_s, 0.8413);
    curve.year.push_back(year_of(time_s));
    curve.values.push_back(0.5 * (low + high));
    curve.sigmas.push_back(0.5 * (high - low));
  }
  return curve;
}

// Dates of the steps that this quantity has part in.
std::vector<double> marks_of(const MachineHistory& machine, std::size_t series) {
  std::vector<double> marks;
  for (const Finding& finding : machine.findings) {
    if (finding.kind == FindingKind::trend || finding.kind == FindingKind::season) continue;
    for (const FindingQuantity& quantity : finding.quantities) {
      if (quantity.series == series) marks.push_back(year_of(0.5 * (finding.from_s + finding.to_s)));
    }
  }
  return marks;
}

// In a ranking the curve that was found, with the scatter from test to test; of one machine the line of its trend.
DrawnQuantity drawn_quantity(const MachineHistory& machine, std::size_t place, bool in_ranking) {
  const QuantityHistory& series = machine.series[place];
  const ToleranceOutlook* const outlook = outlook_for(machine, place);
  const std::size_t n = series.value.size();
  CurveOverYears tests{{}, series.value, in_ranking ? std::vector<double>(n, series.scatter) : series.sigma};
  for (const double time_s : series.time_s) tests.year.push_back(year_of(time_s));
  DrawnQuantity quantity{series.name, series.unit, tests, {}, {}, {}, {}};
  if (in_ranking) {
    quantity.name = fmt::format("{} {}", series.name, name_of(series.plane));
    quantity.trend = CurveOverYears{tests.year, series.fitted, std::vector<double>(n, series.level_sigma)};
  } else if (series.trend) {
    quantity.trend = trend_curve(series, outlook);
  }
  const std::vector<double> marks = marks_of(machine, place);
  if (in_ranking || !marks.empty()) quantity.marks = marks;
  if (outlook != nullptr) {
    quantity.lower = outlook->tolerance.lower;
    quantity.upper = outlook->tolerance.upper;
  }
  return quantity;
}

DrawnMachine drawn_machine(const MachineHistory& machine) {
  DrawnMachine result{machine.name, machine.reason, {}, "", {}};
  std::vector<bool> is_drawn(machine.series.size(), false);
  const auto draw = [&](std::size_t place) {
    if (is_drawn[place]) return;
    is_drawn[place] = true;
    result.quantities.push_back(drawn_quantity(machine, place, true));
  };
  for (const Finding& finding : machine.findings) {
    result.findings.push_back(finding.sentence);
    result.findings.back() += finding.remedy;
    for (const FindingQuantity& quantity : finding.quantities) draw(quantity.series);
  }
  for (const ToleranceOutlook& tolerance : machine.tolerances) {
    if (tolerance.date.outlook == Outlook::beyond || tolerance.date.outlook == Outlook::expected)
      draw(tolerance.series);
  }
  if (!result.quantities.empty()) result.first = result.quantities.front().name;
  return result;
}

// What to look at first: what meets its tolerance, what stepped, what has a trend.
int weight_of(const MachineHistory& machine, std::size_t place) {
  const ToleranceOutlook* const outlook = outlook_for(machine, place);
  if (outlook != nullptr && (outlook->date.outlook == Outlook::beyond || outlook->date.outlook == Outlook::expected)) {
    return 4;
  }
  if (is_found(machine, place, false)) return 3;
  if (is_found(machine, place, true)) return 2;
  return machine.series[place].name == "circularity" ? 1 : 0;
}

DrawnGroup drawn_group(const MachineHistory& machine, std::size_t place) {
  DrawnGroup group{(machine.name.empty() ? "" : machine.name + ": ") + group_text(machine.groups[place]),
                   "",
                   machine.groups[place].plane,
                   {},
                   {"quantity", "unit", "last", "change", "sigmas", "per year", "tolerance", "met"},
                   {}};
  int most = -1;
  for (std::size_t i = 0; i < machine.series.size(); ++i) {
    if (machine.series[i].group != place) continue;
    group.rows.push_back(quantity_row(machine, i));
    group.quantities.push_back(drawn_quantity(machine, i, false));
    if (weight_of(machine, i) <= most) continue;
    most = weight_of(machine, i);
    group.first = machine.series[i].name;
  }
  return group;
}

ReportHead head_of(const std::string& title, const std::vector<std::filesystem::path>& files,
                   std::vector<Paragraph> summary) {
  ReportHead head = report_head(title);
  for (const std::filesystem::path& file : files) head.files.push_back(file.string());
  head.summary = std::move(summary);
  return head;
}

DrawnTest drawn_test(const MachineTest& test) {
  DrawnTest drawn{test, std::nullopt, std::nullopt, ""};
  for (const TestQuantity& one : test.quantities) {
    if (one.name != "circularity") continue;
    drawn.circularity_um = one.value;
    drawn.circularity_sigma_um = one.sigma;
  }
  if (const TestQuantity* const first = first_to_mend(test)) drawn.first_to_mend = first->name;
  return drawn;
}

HistoryReport fleet_report(const std::string& title, const std::vector<std::filesystem::path>& files,
                           const History& history, const std::vector<std::string>& remarks) {
  HistoryReport report{head_of(title, files, conclusion(history)), std::nullopt, FleetPart{ranking_heading(), {}, {}}};
  for (const std::string& remark : remarks) report.head.summary.emplace_back(as_it_is(remark));
  for (const MachineHistory& machine : history.machines) {
    if (machine.need == Need::nothing) continue;
    report.fleet->rows.push_back(ranking_row(machine));
    if (report.fleet->machines.size() < kPictures) report.fleet->machines.push_back(drawn_machine(machine));
  }
  return report;
}

}  // namespace

HistoryReport history_report(const std::string& title, const FoundHistory& found) {
  const auto& [files, history, geometry] = found;
  if (history.machines.size() != 1) return fleet_report(title, files.files, history, {});
  HistoryReport report{head_of(title, files.files, machine_conclusion(history)), HistoryPart(), std::nullopt};
  HistoryPart& part = *report.history;
  const MachineHistory& machine = history.machines.front();
  for (std::size_t i = 0; i < machine.groups.size(); ++i) part.groups.push_back(drawn_group(machine, i));
  const GeometryTexts texts = geometry_texts(files, *geometry);
  part.geometry = texts.sentences;
  part.geometry_rows = texts.rows;
  for (const SkippedTest& test : files.skipped) part.skipped.push_back(test.sentence);
  for (const MachineTest& test : files.tests) part.tests.push_back(drawn_test(test));
  std::stable_sort(part.tests.begin(), part.tests.end(), [](const DrawnTest& left, const DrawnTest& right) {
    return left.test.started_s < right.test.started_s;
  });
  return report;
}

std::string history_page(const std::string& title, const FoundHistory& found) {
  return page_of(json_of(history_report(title, found)), nullptr);
}

std::string ranking_page(const std::string& title, const std::vector<std::filesystem::path>& files,
                         const History& history, const std::vector<std::string>& remarks) {
  return page_of(json_of(fleet_report(title, files, history, remarks)), nullptr);
}
}  // namespace ballbar
