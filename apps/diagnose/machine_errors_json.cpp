// What `diagnose --json` says of the errors of a machine.
#include <cmath>
#include <nlohmann/json.hpp>

#include "ballbar/formats/recordings/stored_errors.hpp"
#include "ballbar/formats/results/fit_results.hpp"
#include "ballbar/units.hpp"
#include "diagnose/machine_errors_report.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json instrument_json(const MachineError& error, const RankedError* ranked) {
  if (!error.as_instrument) return nullptr;
  Json json{{"value", number(*error.as_instrument)}};
  const bool is_ranked = ranked != nullptr && ranked->as_instrument;
  json["individual_circularity_um"] =
      is_ranked ? number(ranked->as_instrument->individual_circularity_um) : Json(nullptr);
  json["share_percent"] = is_ranked ? number(ranked->as_instrument->share_percent) : Json(nullptr);
  json["rank"] = is_ranked ? Json(ranked->as_instrument->rank) : Json(nullptr);
  return json;
}

Json row_json(const ErrorsReport& report, const MachineError& error, const RankedError* ranked) {
  Json json{{"name", error.name}, {"value", number(error.value)}, {"sigma", number(error.sigma)}, {"unit", error.unit}};
  json["as_instrument"] = instrument_json(error, ranked);
  json["significant"] = ranked == nullptr ? Json(nullptr) : Json(ranked->significant);
  json["predicts_other_run"] = ranked == nullptr ? Json(nullptr) : or_null(ranked->predicts_other_run);
  json["individual_circularity_um"] = ranked == nullptr ? Json(nullptr) : number(ranked->individual_circularity_um);
  json["share_percent"] = ranked == nullptr ? Json(nullptr) : number(ranked->share_percent);
  json["rank"] = ranked == nullptr ? Json(nullptr) : or_null(ranked->rank);
  json["stored"] = or_null(stored_value_of(report, error));
  json["stored_is_same"] = or_null(same_as_stored(report, error));
  json["stored_rank"] = ranked == nullptr ? Json(nullptr) : or_null(stored_rank_of(report, *ranked));
  json["circularity_without_um"] = ranked == nullptr ? Json(nullptr) : number(ranked->circularity_without_um);
  json["circularity_gain_um"] = ranked == nullptr ? Json(nullptr) : number(ranked->gain_um);
  json["circularity_gain_sigma_um"] = ranked == nullptr ? Json(nullptr) : number(ranked->gain_sigma_um);
  if (ranked == nullptr) return json;
  json["effect"] = ranked->effect->name;
  json["stored_individual_circularity_um"] =
      or_null(report.b5r ? stored_individual_circularity_um(*report.b5r, ranked->effect->name) : std::nullopt);
  json["p_value"] = number(ranked->p_value);
  json["shape"] = or_null(ranked->shape);
  json["remedy"] = ranked->effect->explanation.remedy;
  if (!report.options.in_the_model.empty()) {
    json["in_the_model"] = report.options.in_the_model.contains(ranked->effect->name);
  }
  return json;
}

void state(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

Json file_json(const B5r& b5r) {
  Json json = Json::object();
  state(json, "test", b5r.test_name);
  state(json, "machine", b5r.machine);
  state(json, "operator", b5r.operator_name);
  state(json, "comment", b5r.comment);
  state(json, "ballbar", b5r.ballbar_model);
  state(json, "serial_number", b5r.serial_number);
  state(json, "last_calibrated", b5r.last_calibrated);
  state(json, "calibrator_serial_number", b5r.calibrator.serial_number);
  state(json, "software", b5r.software_title);
  state(json, "software_version", b5r.software_version);
  if (b5r.started_s) json["started_s"] = *b5r.started_s;
  if (b5r.programmed_feed_mm_per_min) json["programmed_feed_mm_per_min"] = number(*b5r.programmed_feed_mm_per_min);
  return json;
}

}  // namespace

nlohmann::ordered_json json_of(const ErrorsReport& report) {
  const MachineErrors& found = report.found;
  Json json;
  json["files"] = report.files;
  const Recording& first = report.recordings.front();
  json["plane"] = name_of(first.plane);
  json["nominal_length_mm"] = number(first.nominal_length_mm);
  json["recordings"] = Json::array();
  for (const Recording& recording : report.recordings) {
    json["recordings"].push_back(
        {{"direction", name_of(recording.direction)},
         {"arc_deg", number(deg_from_rad(arc_rad(recording)))},
         {"feed_mm_per_min", recording.feed_mm_per_min ? number(*recording.feed_mm_per_min) : Json(nullptr)},
         {"readings", recording.length_mm.size()}});
  }
  if (report.b5r) json["file"] = file_json(*report.b5r);
  json["conclusion"] = conclusion(report);
  json["verdict"] = verdict_of(report);
  json["named"] = Json::array();
  for (const RankedError& one : found.ranked) {
    if (one.significant) json["named"].push_back({{"effect", one.effect->name}, {"columns", Json::object()}});
  }
  json["errors"] = Json::array();
  std::vector<bool> listed(found.errors.size(), false);
  for (const RankedError& ranked : found.ranked) {
    for (const std::size_t row : ranked.rows) {
      json["errors"].push_back(row_json(report, found.errors[row], &ranked));
      listed[row] = true;
    }
  }
  for (std::size_t row = 0; row < found.errors.size(); ++row) {
    if (!listed[row]) json["errors"].push_back(row_json(report, found.errors[row], nullptr));
  }
  json["one_by_one"] = Json::array();
  for (const AddedError& one : found.one_by_one) {
    json["one_by_one"].push_back({{"effect", one.effect->name}, {"rms_um", number(one.rms_um)}});
  }
  json["circle_rms_um"] = number(found.circle_rms_um);
  json["circularity_um"] = number(found.circularity_um);
  json["circularity_without_all_um"] = number(found.circularity_without_all_um);
  json["differences"] = difference_texts(report);
  json["residual_rms_um"] = number(found.residual_rms_um);
  json["repeatability_um"] = number(found.repeatability_um);
  json["noise"] = json_of(found.noise);
  json["left"] = nullptr;
  if (found.left) {
    json["left"] = {{"harmonic", found.left->harmonic},
                    {"recording", found.left->recording},
                    {"peak_to_peak_um", number(found.left->peak_to_peak_um)},
                    {"p_value", number(found.left->p_value)},
                    {"in_both_directions", found.left->in_both}};
  }
  json["left_text"] = left_text(report);
  json["undetermined"] = found.undetermined;
  json["prior"] = Json::array();
  for (const PriorOfError& prior : found.prior) {
    json["prior"].push_back({{"name", prior.name},
                             {"value", 0.0},
                             {"sigma", number(prior.sigma)},
                             {"unit", prior.unit},
                             {"readings_alone", number(prior.alone)},
                             {"readings_alone_sigma", number(prior.alone_sigma)}});
  }
  json["tolerances"] = tolerance_texts(report);
  return json;
}

nlohmann::ordered_json json_of(const ErrorsReports& reports) {
  Json json;
  if (reports.groups.size() == 1 && reports.without_readings.empty()) {
    json = json_of(reports.groups.front());
  } else {
    json["groups"] = Json::array();
    for (const ErrorsReport& group : reports.groups) json["groups"].push_back(json_of(group));
    json["results_alone"] = Json::array();
    for (std::size_t k = 0; k < reports.without_readings.size(); ++k) {
      Json stored = Json::array();
      for (const StoredFeature& feature : reports.without_readings[k].stored) {
        if (!feature.valid) continue;
        stored.push_back({{"parent", feature.parent},
                          {"name", feature.name},
                          {"value", number(feature.value)},
                          {"unit", unit_of_data_type(feature.data_type)}});
      }
      json["results_alone"].push_back({{"file", reports.files_without_readings[k]}, {"stored", stored}});
    }
  }
  json["skipped"] = Json::array();
  for (const SkippedFile& skipped : reports.skipped) {
    json["skipped"].push_back({{"file", skipped.file}, {"why", skipped.why}});
  }
  json["remarks"] = reports.remarks;
  return json;
}

}  // namespace ballbar
