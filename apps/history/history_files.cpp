#include "history/history_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "history/quantity_text.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

Json optional_number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json date_json(const std::optional<std::int64_t>& time_s) {
  return time_s ? Json(iso_date_text(*time_s)) : Json(nullptr);
}

Json day_json(const std::optional<double>& time_s) { return time_s ? Json(date_text(*time_s)) : Json(nullptr); }

Json json_of(const QuantityHistory& quantity, const std::vector<MachineTest>& tests) {
  Json json{{"name", quantity.name},
            {"unit", quantity.unit},
            {"of_set_up", quantity.of_set_up},
            {"last",
             {{"value", number(quantity.last_value)},
              {"sigma", number(quantity.last_sigma)},
              {"significant", quantity.significant}}}};
  if (!quantity.tests.empty()) json["last"]["date"] = date_json(tests[quantity.tests.back()].started_s);
  if (quantity.change) {
    json["change"] = {{"since", date_json(quantity.change->since_s)},
                      {"value", number(quantity.change->value)},
                      {"sigma", number(quantity.change->sigma)},
                      {"significant", quantity.change->significant}};
  }
  if (quantity.trend) {
    json["trend"] = {{"rate_per_year", number(quantity.trend->rate_per_year)},
                     {"sigma_per_year", number(quantity.trend->sigma_per_year)},
                     {"significant", quantity.trend->significant},
                     {"scatter", number(quantity.trend->scatter)},
                     {"tests", quantity.trend->tests}};
  }
  if (quantity.tolerance) {
    json["tolerance"] = {
        {"lower", optional_number(quantity.tolerance->lower)}, {"upper", optional_number(quantity.tolerance->upper)},
        {"outlook", outlook_name(quantity.date->outlook)},     {"met", day_json(quantity.date->at_s)},
        {"earliest", day_json(quantity.date->earliest_s)},     {"latest", day_json(quantity.date->latest_s)}};
  }
  return json;
}

Json json_of(const GroupHistory& history, const std::vector<MachineTest>& tests) {
  const TestGroup& group = history.group;
  Json json{{"plane", name_of(group.plane)},        {"bar", group.bar},
            {"length_mm", group.nominal_length_mm}, {"feed_mm_per_min", optional_number(group.feed_mm_per_min)},
            {"start_deg", number(group.start_deg)}, {"arc_deg", number(group.arc_deg)}};
  json["tests"] = Json::array();
  for (const std::size_t i : group.tests) {
    json["tests"].push_back(
        {{"file", tests[i].file}, {"date", date_json(tests[i].started_s)}, {"stored", tests[i].stored}});
  }
  json["quantities"] = Json::array();
  for (const QuantityHistory& quantity : history.quantities) json["quantities"].push_back(json_of(quantity, tests));
  return json;
}

Json json_of(const MachineGeometry& geometry, const std::vector<MachineTest>& tests) {
  Json json{{"within_a_day", geometry.within_a_day}, {"out_of_square_um_per_m", Json::array()}};
  for (const PlaneSquareness& plane : geometry.squareness) {
    Json files = Json::array();
    for (const std::size_t i : plane.tests) files.push_back(tests[i].file);
    json["out_of_square_um_per_m"].push_back({{"plane", name_of(plane.plane)},
                                              {"value", number(plane.value)},
                                              {"sigma", number(plane.sigma)},
                                              {"p_value", number(plane.p_value)},
                                              {"files", files}});
  }
  json["scales_um_per_m"] = Json::array();
  for (const AxisScale& scale : geometry.scales) {
    json["scales_um_per_m"].push_back({{"axis", std::string(1, "XYZ"[scale.axis])},
                                       {"value", number(scale.value_ppm)},
                                       {"sigma", number(scale.sigma_ppm)},
                                       {"planes", scale.planes}});
  }
  json["agreement"] = {{"chi2", number(geometry.chi2)},
                       {"degrees", geometry.degrees},
                       {"p_value", number(geometry.p_value)},
                       {"scatter_um_per_m", number(geometry.scatter_ppm)},
                       {"pulls", Json::array()}};
  for (const ScalePull& pull : geometry.pulls) {
    json["agreement"]["pulls"].push_back({{"file", tests[pull.test].file},
                                          {"plane", name_of(tests[pull.test].plane)},
                                          {"axis", std::string(1, "XYZ"[pull.axis])},
                                          {"value", number(pull.value_ppm)},
                                          {"sigma", number(pull.sigma_ppm)},
                                          {"pull", number(pull.pull)}});
  }
  return json;
}

}  // namespace

std::string history_csv(const std::vector<MachineTest>& tests) {
  std::string text = "file,date,plane,length_mm,feed_mm_per_min,arc_deg,quantity,value,sigma,unit\n";
  for (const MachineTest& test : tests) {
    const std::string of_test =
        fmt::format("{},{},{},{},{},{:.1f}", csv_text(test.file), test.started_s ? iso_date_text(*test.started_s) : "",
                    name_of(test.plane), test.nominal_length_mm,
                    test.feed_mm_per_min ? fmt::format("{:.1f}", *test.feed_mm_per_min) : "", test.arc_deg);
    for (const TestQuantity& quantity : test.quantities) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", of_test, quantity.name, csv_number(quantity.value),
                     csv_number(quantity.sigma), quantity.unit);
    }
  }
  return text;
}

Json history_json(const TestFiles& files, const std::vector<MachineHistory>& machines) {
  Json json{{"machines", Json::array()}};
  for (const MachineHistory& machine : machines) {
    Json one{{"machine", machine.machine},
             {"changes_judged", machine.changes},
             {"trends_judged", machine.trends},
             {"groups", Json::array()}};
    for (const GroupHistory& group : machine.groups) one["groups"].push_back(json_of(group, files.tests));
    one["geometry"] = json_of(machine.geometry, files.tests);
    json["machines"].push_back(std::move(one));
  }
  json["without_date"] = Json::array();
  for (const MachineTest& test : files.tests) {
    if (!test.started_s) json["without_date"].push_back(test.file);
  }
  json["remarks"] = files.remarks;
  json["skipped"] = Json::array();
  for (const SkippedTest& file : files.skipped) {
    json["skipped"].push_back({{"file", file.file}, {"sentence", file.sentence}});
  }
  return json;
}

}  // namespace ballbar
