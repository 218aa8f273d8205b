#include "history/fleet_page.hpp"

#include <fmt/format.h>

#include "history/fleet_text.hpp"
#include "history/page_parts.hpp"
#include "history/quantity_text.hpp"
#include "page/report_page.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kPictures = 40;  // machines that are drawn

double fleet_year(double time_s) { return 1970.0 + time_s / (365.2425 * 86400.0); }

const FleetTolerance* tolerance_for(const FleetMachine& machine, std::size_t series) {
  for (const FleetTolerance& one : machine.tolerances) {
    if (one.series == series) return &one;
  }
  return nullptr;
}

// Dates of the steps that this quantity has part in.
std::vector<double> marks_of(const FleetMachine& machine, std::size_t series) {
  std::vector<double> marks;
  for (const Finding& finding : machine.findings) {
    if (finding.kind == FindingKind::trend || finding.kind == FindingKind::season) continue;
    for (const FindingQuantity& quantity : finding.quantities) {
      if (quantity.series == series) marks.push_back(fleet_year(0.5 * (finding.from_s + finding.to_s)));
    }
  }
  return marks;
}

DrawnQuantity drawn(const FleetMachine& machine, std::size_t place) {
  const FleetSeries& series = machine.series[place];
  CurveOverYears tests{{}, series.value, std::vector<double>(series.value.size(), series.scatter)};
  for (const double time_s : series.time_s) tests.year.push_back(fleet_year(time_s));
  DrawnQuantity quantity{fmt::format("{} {}", series.name, name_of(series.plane)),
                         series.unit,
                         tests,
                         {{{tests.year, series.fitted, std::vector<double>(series.value.size(), series.sigma)}}},
                         {marks_of(machine, place)},
                         {},
                         {}};
  if (const FleetTolerance* tolerance = tolerance_for(machine, place)) {
    quantity.lower.value = tolerance->tolerance.lower;
    quantity.upper.value = tolerance->tolerance.upper;
  }
  return quantity;
}

DrawnMachine drawn(const FleetMachine& machine) {
  DrawnMachine result{machine.name, machine.reason, {}, "", {}};
  std::vector<bool> is_drawn(machine.series.size(), false);
  const auto draw = [&](std::size_t place) {
    if (is_drawn[place]) return;
    is_drawn[place] = true;
    result.quantities.push_back(drawn(machine, place));
  };
  for (const Finding& finding : machine.findings) {
    result.findings.push_back(finding.sentence + ' ' + finding.remedy);
    for (const FindingQuantity& quantity : finding.quantities) draw(quantity.series);
  }
  for (const FleetTolerance& tolerance : machine.tolerances) {
    if (tolerance.date.outlook == Outlook::beyond || tolerance.date.outlook == Outlook::expected)
      draw(tolerance.series);
  }
  if (!result.quantities.empty()) result.first = result.quantities.front().name;
  return result;
}

}  // namespace

std::string fleet_page(const std::string& title, const std::vector<std::filesystem::path>& files, const Fleet& fleet,
                       const std::vector<std::string>& remarks) {
  FleetReport report{report_head(title), {fleet_heading(), {}, {}}};
  for (const std::filesystem::path& file : files) report.head.files.push_back(file.string());
  report.head.summary = fleet_conclusion(fleet);
  report.head.summary.insert(report.head.summary.end(), remarks.begin(), remarks.end());
  for (const FleetMachine& machine : fleet.machines) {
    if (machine.need == Need::nothing) continue;
    report.fleet.rows.push_back(fleet_row(machine));
    if (report.fleet.machines.size() < kPictures) report.fleet.machines.push_back(drawn(machine));
  }
  return page_of(json_of(report), nullptr);
}

}  // namespace ballbar
