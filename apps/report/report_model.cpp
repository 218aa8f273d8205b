// A model held against data, and what it lacks, as parts of a report.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>

#include "ballbar/fit/effect_response.hpp"
#include "ballbar/fit/model_part.hpp"
#include "ballbar/fit/regime_stretches.hpp"
#include "ballbar/series/folds.hpp"
#include "ballbar/series/runs.hpp"
#include "ballbar/units.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "report/report_parts.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> at_rows(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> chosen;
  chosen.reserve(rows.size());
  for (const std::size_t row : rows) chosen.push_back(values[row]);
  return chosen;
}

Json column(const std::string& name, std::string_view role, std::string_view unit, const std::vector<double>& values) {
  return {{"name", name}, {"role", role}, {"unit", unit}, {"values", bulk(values)}};
}

// What the residual can be plotted against.
Json inputs_of(const Fit& fit, const ModelData& data) {
  Json inputs = Json::array();
  for (const Column& one : data.series.columns) {
    if (one.name == fit.target || one.name.find("_sigma_") != std::string::npos) continue;
    std::vector<double> values = at_rows(one.values, fit.row);
    const auto known = [](double value) { return std::isfinite(value); };
    if (std::none_of(values.begin(), values.end(), known)) continue;
    if (one.name == "angle_rad") {
      std::transform(values.begin(), values.end(), values.begin(), deg_from_rad);
      inputs.push_back(column("angle_deg", name_of(one.role), "deg", values));
    } else {
      inputs.push_back(column(one.name, name_of(one.role), unit_of(one.name), values));
    }
  }
  const std::vector<std::size_t> cycles = folds_of(data.series, fit.row);
  inputs.push_back(column("cycle", "event", "", {cycles.begin(), cycles.end()}));
  return inputs;
}

Json regimes_of(const Series& data) {
  Json stretches = Json::array();
  for (const RegimeStretch& one : regime_stretches(data)) {
    stretches.push_back({{"regime", name_of(one.regime)}, {"from_s", one.from_s}, {"to_s", one.to_s}});
  }
  return stretches;
}

Json steps_of(const Fit& fit, const Model& model, const Series& data) {
  Json steps = Json::array();
  std::size_t first = 1;  // after the constant
  for (const Term& term : model.terms) {
    const std::span parameters(&fit.parameters[first], term.effect->parameters.size());
    first += parameters.size();
    for (std::size_t input = 0; input < term.columns.size(); ++input) {
      const std::optional<StepResponse> step = step_response(term, parameters, input, data);
      if (!step) continue;
      steps.push_back({{"effect", label_of(term)},
                       {"input", step->input},
                       {"from", number(step->from)},
                       {"to", number(step->to)},
                       {"unit", unit_of(step->input)},
                       {"time_s", bulk(step->time_s)},
                       {"response_um", bulk(step->response_um)}});
    }
  }
  return steps;
}

// Of each candidate what it adds that the model cannot make: where it joins, the model's own parameters give way.
void add_curves(Json& candidates, const std::vector<Candidate>& found, const Fit& fit, const Series& data) {
  std::vector<std::vector<double>> curves;
  curves.reserve(found.size());
  for (const Candidate& candidate : found) curves.push_back(curve_of(candidate, fit, data));
  const std::vector<std::vector<double>> made = model_parts_um(fit, curves);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t row = 0; row < curves[i].size(); ++row) curves[i][row] -= made[i][row];
    candidates[i]["label"] = label_of(found[i].bound);
    candidates[i]["best_surrogate_fall"] = number(found[i].best_surrogate_fall);
    candidates[i]["curve_um"] = bulk(curves[i]);
  }
}

Json coherence_of(const Diagnosis& found) {
  std::vector<const Detectability*> testable;
  for (const Detectability& detectable : found.detectability) {
    if (detectable.testability == Testability::testable) testable.push_back(&detectable);
  }
  if (testable.size() < 2) return nullptr;
  Json labels = Json::array(), values = Json::array();
  for (const Detectability* mine : testable) {
    std::map<std::string, double> of;
    for (const Likeness& likeness : mine->imitated_by) of[likeness.with] = likeness.coherence;
    Json row = Json::array();
    for (const Detectability* other : testable) {
      row.push_back(mine == other ? Json(1.0) : number(of[other->effect->name]));
    }
    labels.push_back(label_of(BoundEffect{mine->effect, mine->columns}));
    values.push_back(std::move(row));
  }
  return {{"effects", labels}, {"values", values}};
}

}  // namespace

std::vector<double> curve_of(const Candidate& candidate, const Fit& fit, const Series& data) {
  Term term;
  term.effect = std::shared_ptr<const Effect>(std::shared_ptr<const Effect>(), candidate.bound.effect);
  term.columns = candidate.bound.columns;
  if (candidate.parameters.size() != term.effect->parameters.size()) return {};
  for (const FittedParameter& parameter : candidate.parameters) term.settings.push_back({true, parameter.value});
  return at_rows(effect_um(term, candidate.parameters, data), fit.row);
}

Json check_part(const ResidualReport& residual_report, const Model& model, const ModelData& data) {
  const Fit& fit = residual_report.fit;
  Json json = json_of(residual_report);
  json["level"] = model.level == Level::recording ? "recording" : "series";
  json["floor_text"] = floor_text(fit);
  const bool is_series = model.level == Level::series;
  Series drawn = data.series;
  if (is_series) drawn.time_s = one_after_another(data.series.time_s);
  Json series{{"time_s", bulk(is_series ? at_rows(drawn.time_s, fit.row) : fit.time_s)},
              {"measured_um", bulk(fit.measured_um)},
              {"predicted_um", bulk(fit.predicted_um)},
              {"residual_um", bulk(fit.residual_um)}};
  if (!fit.sigma_um.empty()) series["sigma_um"] = bulk(fit.sigma_um);
  series["contributions"] = Json::array();
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    series["contributions"].push_back(
        {{"effect", label_of(model.terms[t])}, {"values_um", bulk(fit.contribution_um[t])}});
  }
  series["inputs"] = inputs_of(fit, data);
  series["regimes"] = is_series ? regimes_of(drawn) : Json::array();
  json["series"] = std::move(series);
  // Between the tests as well, where a session's signals go on.
  if (is_series && fit.row.size() < data.series.time_s.size()) {
    json["curve"] = {{"time_s", bulk(drawn.time_s)},
                     {"predicted_um", bulk(predict(model, fit.parameters, data.series).predicted_um)}};
  }
  json["steps"] = is_series ? steps_of(fit, model, data.series) : Json::array();
  return json;
}

Json diagnosis_part(const DiagnosisReport& diagnosis_report, const ModelData& data) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  Json json = json_of(diagnosis_report);
  for (const char* key : {"where", "parameters", "correlation", "noise", "whiteness", "sentences", "remarks"}) {
    json.erase(key);  // as in the check of the same target
  }
  json["rmse_after_um"] = number(found.rmse_after_um);
  json["next_test_text"] = next_text(diagnosis_report);
  json["hint"] = diagnosis_report.hint;
  for (std::size_t i = 0; i < found.effects.size(); ++i) {
    json["effects"][i]["label"] = label_of(found.effects[i].bound);
  }
  const Fit& fit = diagnosis_report.residual_report.fit;
  // Noise with a long memory lets the model's parameters stand off the readings; beside what is missing they do not.
  json["refit_um"] = bulk(model_parts_um(fit, {fit.residual_um}).front());
  add_curves(json["candidates"], found.candidates, fit, data.series);
  json["coherence"] = coherence_of(found);
  return json;
}

}  // namespace ballbar
