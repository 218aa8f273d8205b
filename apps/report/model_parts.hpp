// The parts of a page that are of a model beside data.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/fit/residual.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "report/data_parts.hpp"

namespace ballbar {

template <>
struct ResultType<RegimeStretch> {
  static constexpr std::string_view name = "RegimeStretch";
  static constexpr std::string_view meaning = "A stretch of time with one regime of the speed.";
  static constexpr std::tuple fields{Field{"regime", &RegimeStretch::regime, ""},
                                     Field{"from_s", known(&RegimeStretch::from_s), ""},
                                     Field{"to_s", known(&RegimeStretch::to_s), ""}};
};

struct CheckedSeries {
  Bulk time_s, measured_um, predicted_um, residual_um;
  MayLack<Bulk> sigma_um;
  std::vector<EffectCurve> contributions;
  std::vector<PageColumn> inputs;
  std::vector<RegimeStretch> regimes;
};

template <>
struct ResultType<CheckedSeries> {
  static constexpr std::string_view name = "CheckedSeries";
  static constexpr std::string_view meaning = "The rows of a fit.";
  static constexpr std::tuple fields{Field{"time_s", known(&CheckedSeries::time_s), ""},
                                     Field{"measured_um", &CheckedSeries::measured_um, ""},
                                     Field{"predicted_um", &CheckedSeries::predicted_um, ""},
                                     Field{"residual_um", &CheckedSeries::residual_um, ""},
                                     Field{"sigma_um", &CheckedSeries::sigma_um, "where readings state it"},
                                     Field{"contributions", &CheckedSeries::contributions, "of each effect"},
                                     Field{"inputs", &CheckedSeries::inputs,
                                           "at the same rows: signals, or angle_deg, direction, recording; and cycle"},
                                     Field{"regimes", &CheckedSeries::regimes, "of the speed, where it is known"}};
};

struct ModelCurve {
  Bulk time_s, predicted_um;
};

template <>
struct ResultType<ModelCurve> {
  static constexpr std::string_view name = "ModelCurve";
  static constexpr std::string_view meaning = "A model over time.";
  static constexpr std::tuple fields{Field{"time_s", known(&ModelCurve::time_s), ""},
                                     Field{"predicted_um", &ModelCurve::predicted_um, ""}};
};

struct EffectStep {
  std::string effect, input;
  double from = 0.0, to = 0.0;
  std::string unit;
  Bulk time_s, response_um;
};

template <>
struct ResultType<EffectStep> {
  static constexpr std::string_view name = "EffectStep";
  static constexpr std::string_view meaning =
      "What an effect answers to a step of its input from the least to the largest value in the data.";
  static constexpr std::tuple fields{Field{"effect", &EffectStep::effect, ""},
                                     Field{"input", &EffectStep::input, ""},
                                     Field{"from", known(&EffectStep::from), ""},
                                     Field{"to", known(&EffectStep::to), ""},
                                     Field{"unit", &EffectStep::unit, ""},
                                     Field{"time_s", known(&EffectStep::time_s), ""},
                                     Field{"response_um", &EffectStep::response_um, ""}};
};

struct CheckPart {
  ResidualReport report;
  std::string level, floor_text;
  CheckedSeries series;
  MayLack<ModelCurve> curve;
  std::vector<EffectStep> steps;
};

template <>
struct ResultType<CheckPart> {
  static constexpr std::string_view name = "CheckPart";
  static constexpr std::string_view meaning = "A model fitted, with its curves.";
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&CheckPart::report, ResultType<ResidualReport>::fields),
      std::tuple{Field{"level", &CheckPart::level, "series, recording"},
                 Field{"floor_text", &CheckPart::floor_text, ""}, Field{"series", &CheckPart::series, ""},
                 Field{"curve", &CheckPart::curve, "the model between the rows too, where signals go on there"},
                 Field{"steps", &CheckPart::steps, "of a drift series only"}});
};

struct PageEffect {
  EffectProbability probability;
};

template <>
struct ResultType<PageEffect> {
  static constexpr std::string_view name = "LabelledEffect";
  static constexpr std::string_view meaning = "An effect, and the probability that it is missing, with its label.";
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&PageEffect::probability, ResultType<EffectProbability>::fields),
      std::tuple{Field{"label", [](const PageEffect& of) { return label_of(of.probability.bound); }, ""}});
};

struct PageCandidate {
  Candidate candidate;
  Bulk curve_um;
};

template <>
struct ResultType<PageCandidate> {
  static constexpr std::string_view name = "DrawnCandidate";
  static constexpr std::string_view meaning = "An effect that may be missing, with its curve.";
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&PageCandidate::candidate, ResultType<Candidate>::fields),
      std::tuple{Field{"label", [](const PageCandidate& of) { return label_of(of.candidate.bound); },
                       "lagged_expansion(T_room_degC)"},
                 Field{"curve_um", &PageCandidate::curve_um,
                       "what it adds that the model cannot make itself, at the rows of the checked series"}});
};

struct Coherence {
  std::vector<std::string> effects;
  std::vector<std::vector<double>> values;
};

template <>
struct ResultType<Coherence> {
  static constexpr std::string_view name = "Coherence";
  // |cos| between what survives of both beside the model, the median over the shapes of the row, each with the shape of
  // the column that is most like it. Not symmetric: one with more shapes imitates more.
  static constexpr std::string_view meaning =
      "Which effect (column) could be confused with one that might be there (row): possible above 0.95.";
  static constexpr std::tuple fields{Field{"effects", &Coherence::effects, ""},
                                     Field{"values", &Coherence::values, ""}};
};

struct DiagnosisPart {
  DiagnosisReport report;
  std::vector<PageEffect> effects;
  std::vector<PageCandidate> candidates;
  Bulk refit_um;
  std::optional<Coherence> coherence;
};

template <>
struct ResultType<DiagnosisPart> {
  using Of = const DiagnosisPart&;
  using Report = ResultType<DiagnosisReport>;
  using Checked = ResultType<ResidualReport>;
  static constexpr std::string_view name = "DiagnosisPart";
  static constexpr std::string_view meaning =
      "Which effect a model lacks, with curves; what the check has is there alone.";
  static constexpr std::tuple of_check =
      fields_through(&DiagnosisReport::residual_report, std::tuple_cat(Checked::figures, Checked::end));
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&DiagnosisPart::report, std::tuple_cat(of_check, Report::verdict_fields)),
      std::tuple{Field{"effects", &DiagnosisPart::effects, Report::kEffects}},
      fields_through(&DiagnosisPart::report, fields_through(&DiagnosisReport::diagnosis, Report::probabilities)),
      std::tuple{Field{"candidates", &DiagnosisPart::candidates, Report::kCandidates}},
      fields_through(&DiagnosisPart::report, Report::open),
      std::tuple{Field{"rmse_after_um", [](Of of) { return of.report.diagnosis.rmse_after_um; }, "with the best set"},
                 Field{"next_test_text", [](Of of) { return next_text(of.report); },
                       "as the terminal has it; empty: none is needed"},
                 Field{"hint", [](Of of) { return of.report.hint; }, "what no command does; empty: nothing"},
                 Field{"refit_um", &DiagnosisPart::refit_um,
                       "by what the model's own parameters give way beside what is missing, at the same rows"},
                 Field{"coherence", &DiagnosisPart::coherence, "null: nothing to compare"}});
};

struct CheckParts {
  std::vector<CheckPart> targets;
};

template <>
struct ResultType<CheckParts> {
  static constexpr std::string_view name = "CheckParts";
  static constexpr std::string_view meaning = "A model fitted to each target.";
  static constexpr std::tuple fields{Field{"targets", &CheckParts::targets, ""}};
};

struct DiagnosisParts {
  std::vector<std::variant<DiagnosisPart, NotDiagnosed>> targets;
};

template <>
struct ResultType<DiagnosisParts> {
  static constexpr std::string_view name = "DiagnosisParts";
  static constexpr std::string_view meaning = "What a model of each target lacks.";
  static constexpr std::tuple fields{Field{"targets", &DiagnosisParts::targets, ""}};
};

}  // namespace ballbar
