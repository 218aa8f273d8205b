// Recordings and their fits as parts of a report.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "ballbar/units.hpp"
#include "report/report_parts.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> deviation_um(const Recording& recording) {
  std::vector<double> deviation;
  deviation.reserve(recording.length_mm.size());
  for (const double length_mm : recording.length_mm) {
    deviation.push_back(um_from_mm(length_mm - recording.nominal_length_mm));
  }
  return deviation;
}

Json trace_of_circle(const FittedRecording& fitted) {
  const std::vector<double> deviation = deviation_um(fitted.recording);
  const Eigen::ArrayXd left = residual_um(fitted.recording, *fitted.circle);
  std::vector<double> angle_deg, residual, circle;
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    angle_deg.push_back(deg_from_rad(fitted.recording.angle_rad[i]));
    residual.push_back(left[static_cast<Eigen::Index>(i)]);
    circle.push_back(deviation[i] - residual.back());
  }
  return {{"angle_deg", bulk(angle_deg)},
          {"deviation_um", bulk(deviation)},
          {"residual_um", bulk(residual)},
          {"fitted_um", bulk(circle)},
          {"effects", Json::array()}};
}

Json trace_of_length(const FittedRecording& fitted) {
  const std::vector<double> deviation = deviation_um(fitted.recording);
  Json json{{"angle_deg", Json::array()}, {"deviation_um", bulk(deviation)}};
  const double mean_um = um_from_mm(fitted.axial->length_mm - fitted.recording.nominal_length_mm);
  std::vector<double> residual = deviation;
  for (double& value : residual) value -= mean_um;
  json["residual_um"] = bulk(residual);
  json["fitted_um"] = bulk(std::vector<double>(residual.size(), mean_um));
  json["effects"] = Json::array();
  if (!fitted.recording.time_s.empty()) json["time_s"] = bulk(fitted.recording.time_s);
  return json;
}

Json results_of(const std::string& name, const std::vector<Compared>& results) {
  Json rows = Json::array();
  for (const Compared& result : results) {
    Json row{{"label", result.label}, {"decimals", result.decimals}, {"ours", number(result.ours)}};
    row["stored"] = result.stored ? number(*result.stored) : Json(nullptr);
    if (result.judgement) {
      const auto end = [](const std::optional<double>& limit) { return limit ? number(*limit) : Json(nullptr); };
      row["limits"] = {end(result.limits.lower), end(result.limits.upper)};
      row["judgement"] = name_of(*result.judgement);
    }
    rows.push_back(std::move(row));
  }
  return {{"of", name}, {"rows", rows}};
}

std::string what_of(const Recording& recording) {
  if (recording.kind == Kind::axial) return "axial";
  return fmt::format("{} {}", name_of(recording.plane), name_of(recording.direction));
}

// One test a file; nothing: the recordings belong to no session.
Json part(const Fitted& fitted, const SessionFiles* session) {
  Json json;
  json["recordings"] = Json::array();
  json["results"] = Json::array();
  json["remarks"] = Json::array();
  std::size_t place = 0;  // in session->recordings
  for (std::size_t i = 0; i < fitted.recordings.size(); ++i) {
    const FittedRecording& one = fitted.recordings[i];
    if (session != nullptr) {
      while (session->recordings[place].file != one.file) ++place;
    }
    const std::string file = std::filesystem::path(one.file).filename().string();
    Json recording = json_of(one);
    recording["file"] = file;  // where it lay is nobody's business whom the page is mailed to
    recording["time_s"] = nullptr;
    recording["test"] = file;
    if (session != nullptr) {
      const double time_s = session->session.tests[session->recordings[place].test].elapsed_s;
      recording["time_s"] = time_s;
      recording["test"] = fmt::format("{:g} min", min_from_s(time_s));
    }
    const std::string label = fmt::format("{}, {}", recording["test"].get<std::string>(), what_of(one.recording));
    recording["label"] = label;
    recording["trace"] = one.circle ? trace_of_circle(one) : trace_of_length(one);
    json["recordings"].push_back(std::move(recording));
    if (!one.results.empty()) json["results"].push_back(results_of(label, one.results));
    if (one.circle && !one.circle->converged) {
      json["remarks"].push_back(fmt::format("{}: the fit did not converge: {}.", label, one.circle->outcome));
    }
  }
  json["pairs"] = Json::array();
  for (const FittedPair& pair : fitted.pairs) {
    json["pairs"].push_back({pair.ccw, pair.cw});
    const std::string file = std::filesystem::path(pair.file).filename().string();
    json["results"].push_back(results_of("ISO 230-4, " + file, pair.results));
    for (const std::string& remark : pair.remarks) json["remarks"].push_back(fmt::format("{}: {}", file, remark));
  }
  for (const ResultsAlone& alone : fitted.results_alone) {
    Json stored = json_of(alone);
    stored["file"] = std::filesystem::path(alone.file).filename().string();
    json["stored_alone"].push_back(std::move(stored));
  }
  const Json all = json_of(fitted);
  for (const char* key : {"iso230_4", "iso230_4_pairs"}) {
    if (all.contains(key)) json[key] = all[key];
  }
  return json;
}

}  // namespace

Json recordings_part(const Fitted& fitted) { return part(fitted, nullptr); }

Json recordings_part(const Fitted& fitted, const SessionFiles& session) { return part(fitted, &session); }

void overlay(Json& recordings, const std::string& effect, const std::vector<double>& values_um, const Fit& fit,
             const Series& trace) {
  const Column* number_of = find_column(trace, "recording");
  std::vector<Json*> circles;
  for (Json& recording : recordings) {
    if (recording["kind"] == "circle") circles.push_back(&recording);
  }
  std::vector<std::vector<double>> values(circles.size());
  for (std::size_t i = 0; i < fit.row.size(); ++i) {
    values.at(static_cast<std::size_t>(number_of->values[fit.row[i]])).push_back(values_um[i]);
  }
  for (std::size_t k = 0; k < circles.size(); ++k) {
    (*circles[k])["trace"]["effects"].push_back({{"effect", effect}, {"values_um", bulk(values[k])}});
  }
}

}  // namespace ballbar
