// A model held against data, and what it lacks, as parts of a report.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/fit/effect_response.hpp"
#include "ballbar/internal/fit/model_part.hpp"
#include "ballbar/internal/series/folds.hpp"
#include "ballbar/series/series.hpp"
#include "ballbar/units.hpp"
#include "model/effects_result.hpp"
#include "report/report_results.hpp"

namespace ballbar {
namespace {

// What the residual can be plotted against.
std::vector<PageColumn> inputs_of(const Fit& fit, const ModelData& data) {
  std::vector<PageColumn> inputs;
  for (const Column& one : data.series->columns) {
    if (one.name == fit.target || one.name.find("_sigma_") != std::string::npos) continue;
    std::vector<double> values = at_rows(one.values, fit.row);
    const auto known = [](double value) { return std::isfinite(value); };
    if (std::none_of(values.begin(), values.end(), known)) continue;
    if (one.name == "angle_rad") {
      std::transform(values.begin(), values.end(), values.begin(), deg_from_rad);
      inputs.push_back({"angle_deg", one.role, "deg", {std::move(values)}});
    } else {
      inputs.push_back({one.name, one.role, std::string(unit_of(one.name)), {std::move(values)}});
    }
  }
  const std::vector<std::size_t> cycles = folds_of(*data.series, fit.row);
  inputs.push_back({"cycle", Role::event, "", {{cycles.begin(), cycles.end()}}});
  return inputs;
}

std::vector<EffectStep> steps_of(const Fit& fit, const Model& model, const Series& data) {
  std::vector<EffectStep> steps;
  std::size_t first = 1;  // after the constant
  for (const Term& term : model.terms) {
    const std::span parameters(&fit.parameters[first], term.effect->parameters.size());
    first += parameters.size();
    for (std::size_t input = 0; input < term.columns.size(); ++input) {
      const std::optional<StepResponse> step = step_response(term, parameters, input, data);
      if (!step) continue;
      steps.push_back({label_of(term),
                       step->input,
                       step->from,
                       step->to,
                       std::string(unit_of(step->input)),
                       {step->time_s},
                       {step->response_um}});
    }
  }
  return steps;
}

// Of each candidate what it adds that the model cannot make: where it joins, the model's own parameters give way.
std::vector<PageCandidate> drawn(const std::vector<Candidate>& found, const Fit& fit, const Series& data) {
  std::vector<std::vector<double>> curves;
  curves.reserve(found.size());
  for (const Candidate& candidate : found) curves.push_back(curve_of(candidate, fit, data));
  const std::vector<std::vector<double>> made = model_parts_um(fit, curves);
  std::vector<PageCandidate> candidates;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t row = 0; row < curves[i].size(); ++row) curves[i][row] -= made[i][row];
    candidates.push_back({found[i], {std::move(curves[i])}});
  }
  return candidates;
}

std::optional<Coherence> coherence_of(const Diagnosis& found) {
  std::vector<const Detectability*> testable;
  for (const Detectability& detectable : found.detectability) {
    if (detectable.testability == Testability::testable) testable.push_back(&detectable);
  }
  if (testable.size() < 2) return std::nullopt;
  Coherence coherence;
  for (const Detectability* mine : testable) {
    std::map<std::string, double> of;
    for (const Likeness& likeness : mine->imitated_by) of[likeness.with] = likeness.coherence;
    coherence.effects.push_back(label_of(BoundEffect{mine->effect, mine->columns}));
    coherence.values.emplace_back();
    for (const Detectability* other : testable)
      coherence.values.back().push_back(mine == other ? 1.0 : of[other->effect->name]);
  }
  return coherence;
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

CheckPart check_part(const ResidualReport& residual_report, const Model& model, const ModelData& data) {
  const Fit& fit = residual_report.fit;
  const bool is_series = model.level == Level::series;
  Series drawn = *data.series;
  if (is_series) drawn.time_s = one_after_another(data.series->time_s);
  CheckedSeries series{{is_series ? at_rows(drawn.time_s, fit.row) : fit.time_s},
                       {fit.measured_um},
                       {fit.predicted_um},
                       {fit.residual_um},
                       {},
                       {},
                       inputs_of(fit, data),
                       is_series ? regime_stretches(drawn) : std::vector<RegimeStretch>()};
  if (!fit.sigma_um.empty()) series.sigma_um = Bulk{fit.sigma_um};
  for (std::size_t t = 0; t < model.terms.size(); ++t)
    series.contributions.push_back({label_of(model.terms[t]), {fit.contribution_um[t]}});
  CheckPart part{residual_report, std::string(name_of(model.level)), floor_sentences(fit), std::move(series), {}, {}};
  if (!is_series) return part;
  // Between the tests as well, where a session's signals go on.
  if (fit.row.size() < data.series->time_s.size())
    part.curve = {{drawn.time_s}, {predict(model, fit.parameters, *data.series).predicted_um}};
  part.steps = steps_of(fit, model, *data.series);
  return part;
}

DiagnosisPart diagnosis_part(const DiagnosisReport& diagnosis_report, const ModelData& data) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  const Fit& fit = diagnosis_report.residual_report.fit;
  // Noise with a long memory lets the model's parameters stand off the readings; beside what is missing they do not.
  return {diagnosis_report,
          drawn(found.candidates, fit, *data.series),
          {model_parts_um(fit, {fit.residual_um}).front()},
          coherence_of(found)};
}

}  // namespace ballbar
