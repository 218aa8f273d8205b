#include <nlohmann/json.hpp>

#include "measure/recording_fits.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

Json stored_of(const std::vector<Compared>& results) {
  Json stored = Json::object();
  for (const Compared& result : results) {
    if (result.stored) stored[result.key] = *result.stored;
  }
  return stored;
}

}  // namespace

Json json_of(const FittedRecording& fitted) {
  const Recording& recording = fitted.recording;
  Json json = {{"file", fitted.file}, {"index", fitted.index}, {"kind", name_of(recording.kind)}};
  json["readings"] = recording.length_mm.size();
  json["nominal_length_mm"] = recording.nominal_length_mm;
  if (fitted.axial) {
    json["length_mm"] = fitted.axial->length_mm;
    json["sigma_length_um"] = number(fitted.axial->sigma_um);
    json["rms_um"] = fitted.axial->rms_um;
    return json;
  }
  const Circle& circle = *fitted.circle;
  const Circularity& round = *fitted.circularity;
  json["plane"] = name_of(recording.plane);
  json["direction"] = name_of(recording.direction);
  json["arc_deg"] = circle.arc_deg;
  json["model"] = circle.model == CircleModel::polar ? "polar" : "length_equation";
  for (const Compared& result : fitted.results) json[result.key] = number(result.ours);
  json["rms_um"] = circle.rms_um;
  json["sigma_centre_a_um"] = number(circle.sigma_centre_a_um());
  json["sigma_centre_b_um"] = number(circle.sigma_centre_b_um());
  json["sigma_radius_um"] = number(circle.sigma_radius_um());
  json["sigma_circularity_um"] = number(round.circular_deviation_sigma_um);
  json["correlation_a_b"] = number(circle.correlation_a_b());
  json["correlation_a_radius"] = number(circle.correlation_a_radius());
  json["correlation_b_radius"] = number(circle.correlation_b_radius());
  json["sigma_reading_um"] = circle.sigma_reading_um;
  json["autocorrelation"] = circle.autocorrelation;
  json["effective_readings"] = circle.effective_readings;
  json["max_circular_um"] = round.max_circular_um;
  json["max_at_deg"] = round.max_at_deg;
  json["min_circular_um"] = round.min_circular_um;
  json["min_at_deg"] = round.min_at_deg;
  json["converged"] = circle.converged;
  json["discounted"] = circle.discounted;
  if (const Json stored = stored_of(fitted.results); !stored.empty()) json["stored"] = stored;
  return json;
}

Json json_of(const FittedPair& pair) {
  Json json = Json::object();
  for (const Compared& result : pair.results) json[result.key] = result.ours;
  if (const Json stored = stored_of(pair.results); !stored.empty()) json["stored"] = stored;
  if (!pair.remarks.empty()) json["remarks"] = pair.remarks;
  return json;
}

// One pair: "iso230_4" is its object. Several: "iso230_4_pairs" has one object a pair, with its file.
Json json_of(const Fitted& fitted) {
  Json json;
  json["recordings"] = Json::array();
  for (const FittedRecording& recording : fitted.recordings) json["recordings"].push_back(json_of(recording));
  for (const ResultsAlone& alone : fitted.results_alone) json["results_alone"].push_back(json_of(alone));
  if (fitted.pairs.size() == 1) json["iso230_4"] = json_of(fitted.pairs.front());
  if (fitted.pairs.size() > 1) {
    for (const FittedPair& pair : fitted.pairs) {
      Json one = {{"file", pair.file}};
      one.update(json_of(pair));
      json["iso230_4_pairs"].push_back(one);
    }
  }
  return json;
}

}  // namespace ballbar
