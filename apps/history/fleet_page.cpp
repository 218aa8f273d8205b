#include "history/fleet_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "history/fleet_text.hpp"
#include "history/quantity_text.hpp"
#include "page/report_page.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPictures = 40;  // machines that are drawn

double fleet_year(double time_s) { return 1970.0 + time_s / (365.2425 * 86400.0); }

const FleetTolerance* tolerance_for(const FleetMachine& machine, std::size_t series) {
  for (const FleetTolerance& one : machine.tolerances) {
    if (one.series == series) return &one;
  }
  return nullptr;
}

// Dates of the steps that this quantity has part in.
Json marks_json(const FleetMachine& machine, std::size_t series) {
  Json marks = Json::array();
  for (const Finding& finding : machine.findings) {
    if (finding.kind == FindingKind::trend || finding.kind == FindingKind::season) continue;
    for (const FindingQuantity& quantity : finding.quantities) {
      if (quantity.series == series) marks.push_back(number(fleet_year(0.5 * (finding.from_s + finding.to_s))));
    }
  }
  return marks;
}

Json quantity_json(const FleetMachine& machine, std::size_t place) {
  const FleetSeries& series = machine.series[place];
  Json years = Json::array(), values = Json::array(), sigmas = Json::array(), fitted = Json::array(),
       of_fit = Json::array();
  for (std::size_t i = 0; i < series.value.size(); ++i) {
    years.push_back(number(fleet_year(series.time_s[i])));
    values.push_back(number(series.value[i]));
    sigmas.push_back(number(series.scatter));
    fitted.push_back(number(series.fitted[i]));
    of_fit.push_back(number(series.sigma));
  }
  Json json{{"name", fmt::format("{} {}", series.name, name_of(series.plane))},
            {"unit", series.unit},
            {"year", years},
            {"values", values},
            {"sigmas", sigmas},
            {"trend", {{"year", years}, {"values", fitted}, {"sigmas", of_fit}}},
            {"marks", marks_json(machine, place)}};
  const FleetTolerance* tolerance = tolerance_for(machine, place);
  if (tolerance != nullptr && tolerance->tolerance.lower) json["lower"] = *tolerance->tolerance.lower;
  if (tolerance != nullptr && tolerance->tolerance.upper) json["upper"] = *tolerance->tolerance.upper;
  return json;
}

Json machine_json(const FleetMachine& machine) {
  Json json{{"label", machine.name},
            {"reason", machine.reason},
            {"findings", Json::array()},
            {"first", ""},
            {"quantities", Json::array()}};
  std::vector<bool> drawn(machine.series.size(), false);
  const auto draw = [&](std::size_t place) {
    if (drawn[place]) return;
    drawn[place] = true;
    json["quantities"].push_back(quantity_json(machine, place));
  };
  for (const Finding& finding : machine.findings) {
    json["findings"].push_back(finding.sentence + ' ' + finding.remedy);
    for (const FindingQuantity& quantity : finding.quantities) draw(quantity.series);
  }
  for (const FleetTolerance& tolerance : machine.tolerances) {
    if (tolerance.date.outlook == Outlook::beyond || tolerance.date.outlook == Outlook::expected)
      draw(tolerance.series);
  }
  if (!json["quantities"].empty()) json["first"] = json["quantities"].front()["name"];
  return json;
}

}  // namespace

std::string fleet_page(const std::string& title, const std::vector<std::filesystem::path>& files, const Fleet& fleet,
                       const std::vector<std::string>& remarks) {
  Json report{{"format", "ballbar-report 1"}, {"title", title},         {"made_by", "ballbar " BALLBAR_VERSION},
              {"made_on", page_date()},       {"files", Json::array()}, {"summary", Json::array()},
              {"signals", Json::array()}};
  for (const std::filesystem::path& file : files) report["files"].push_back(file.string());
  for (const std::string& line : fleet_conclusion(fleet)) report["summary"].push_back(line);
  for (const std::string& line : remarks) report["summary"].push_back(line);
  Json part{{"heading", fleet_heading()}, {"rows", Json::array()}, {"machines", Json::array()}};
  for (const FleetMachine& machine : fleet.machines) {
    if (machine.need == Need::nothing) continue;
    part["rows"].push_back(fleet_row(machine));
    if (part["machines"].size() < kPictures) part["machines"].push_back(machine_json(machine));
  }
  report["fleet"] = std::move(part);
  return page_of(report, nullptr);
}

}  // namespace ballbar
