#include "history/fleet_json.hpp"

#include "history/quantity_text.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

Json limit_json(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json fleet_day(const std::optional<double>& time_s) { return time_s ? Json(date_text(*time_s)) : Json(nullptr); }

Json numbers_json(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(number(value));
  return json;
}

Json json_of(const FleetMachine& machine, const FindingQuantity& quantity) {
  const FleetSeries& series = machine.series[quantity.series];
  return {{"quantity", series.name},
          {"plane", name_of(series.plane)},
          {"unit", series.unit},
          {"size", number(quantity.size)},
          {"sigma", number(quantity.sigma)},
          {"p_value", number(quantity.p_value)},
          {"q_value", number(quantity.q_value)}};
}

Json json_of(const FleetMachine& machine, const Finding& finding) {
  Json json{{"kind", name_of(finding.kind)},
            {"from", date_text(finding.from_s)},
            {"to", date_text(finding.to_s)},
            {"axis", finding.axis ? Json(std::string(1, "XYZ"[*finding.axis])) : Json(nullptr)},
            {"p_value", number(finding.p_value)},
            {"q_value", number(finding.q_value)},
            {"sentence", finding.sentence},
            {"remedy", finding.remedy},
            {"quantities", Json::array()}};
  for (const FindingQuantity& quantity : finding.quantities) json["quantities"].push_back(json_of(machine, quantity));
  return json;
}

Json json_of(const FleetMachine& machine, const FleetTolerance& tolerance) {
  const FleetSeries& series = machine.series[tolerance.series];
  return {{"quantity", series.name},
          {"plane", name_of(series.plane)},
          {"unit", series.unit},
          {"level", number(series.level)},
          {"sigma", number(series.sigma)},
          {"lower", limit_json(tolerance.tolerance.lower)},
          {"upper", limit_json(tolerance.tolerance.upper)},
          {"outlook", outlook_name(tolerance.date.outlook)},
          {"met", fleet_day(tolerance.date.at_s)},
          {"earliest", fleet_day(tolerance.date.earliest_s)},
          {"latest", fleet_day(tolerance.date.latest_s)},
          {"last_test_alone", tolerance.last_alone}};
}

Json json_of(const FleetSeries& series) {
  Json json{
      {"quantity", series.name},       {"plane", name_of(series.plane)},       {"unit", series.unit},
      {"level", number(series.level)}, {"sigma", number(series.sigma)},        {"scatter", number(series.scatter)},
      {"dates", Json::array()},        {"values", numbers_json(series.value)}, {"fitted", numbers_json(series.fitted)}};
  for (const double time_s : series.time_s) json["dates"].push_back(date_text(time_s));
  return json;
}

}  // namespace

Json json_of(const Fleet& fleet) {
  Json json{{"machines", Json::array()},
            {"bar_changes", Json::array()},
            {"judged", fleet.judged},
            {"found", fleet.found},
            {"false_discovery_rate", number(fleet.false_discovery_rate)},
            {"without_date", fleet.without_date}};
  for (const FleetMachine& machine : fleet.machines) {
    Json one{
        {"machine", machine.name},           {"tests", machine.tests},        {"first", fleet_day(machine.first_s)},
        {"last", fleet_day(machine.last_s)}, {"need", name_of(machine.need)}, {"reason", machine.reason},
        {"findings", Json::array()},         {"tolerances", Json::array()},   {"series", Json::array()}};
    for (const Finding& finding : machine.findings) one["findings"].push_back(json_of(machine, finding));
    for (const FleetTolerance& tolerance : machine.tolerances) one["tolerances"].push_back(json_of(machine, tolerance));
    for (const FleetSeries& series : machine.series) one["series"].push_back(json_of(series));
    json["machines"].push_back(std::move(one));
  }
  for (const BarChange& change : fleet.bar_changes) {
    Json machines = Json::array();
    for (const std::size_t place : change.machines) machines.push_back(fleet.machines[place].name);
    json["bar_changes"].push_back({{"from", change.from},
                                   {"to", change.to},
                                   {"machines", machines},
                                   {"step_um_per_m", number(change.size_ppm)},
                                   {"sigma_um_per_m", number(change.sigma_ppm)}});
  }
  return json;
}

}  // namespace ballbar
