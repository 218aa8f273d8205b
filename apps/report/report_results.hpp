// The parts of a page: what commands print with --json, and the curves that the page draws.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/drift/measured_drift.hpp"
#include "ballbar/fit/regime_stretches.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "diagnose/machine_errors_result.hpp"
#include "diagnose/revision_results.hpp"
#include "measure/comparison_result.hpp"
#include "measure/fit_result.hpp"
#include "page/report_head.hpp"
#include "predict/predict_batch.hpp"

namespace ballbar {

// What an effect adds.
struct EffectCurve {
  std::string effect;
  Bulk values_um;
};

template <>
struct ResultType<EffectCurve> {
  static constexpr std::string_view name = "EffectCurve";
  static constexpr std::string_view meaning = "What an effect adds.";
  static constexpr std::tuple fields{Field{"effect", &EffectCurve::effect, "with its columns"},
                                     Field{"values_um", &EffectCurve::values_um, ""}};
};

// The curves of a recording.
struct Trace {
  Bulk angle_deg, deviation_um, residual_um, fitted_um;
  std::vector<EffectCurve> effects;
  MayLack<Bulk> time_s;
};

template <>
struct ResultType<Trace> {
  static constexpr std::string_view name = "Trace";
  static constexpr std::string_view meaning = "The readings of a recording, and what was fitted.";
  static constexpr std::tuple fields{
      Field{"angle_deg", &Trace::angle_deg, "of a circle"},
      Field{"deviation_um", &Trace::deviation_um, "measured length less nominal"},
      Field{"residual_um", &Trace::residual_um, "reading less what was fitted"},
      Field{"fitted_um", &Trace::fitted_um, "deviation of what was fitted, at the same readings"},
      Field{"effects", &Trace::effects, "what each effect of a model adds"},
      Field{"time_s", &Trace::time_s, "of an axial one"}};
};

struct PageRecording {
  FittedRecording fitted;
  std::optional<double> time_s;
  std::string test, label;
  Trace trace;
};

template <>
struct ResultType<PageRecording> {
  static constexpr std::string_view name = "PageRecording";
  static constexpr std::string_view meaning = "A recording with its curves.";
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&PageRecording::fitted, ResultType<FittedRecording>::fields),
      std::tuple{Field{"time_s", &PageRecording::time_s, "of the test in its session; null: of none"},
                 Field{"test", &PageRecording::test, "64 min, or the file"},
                 Field{"label", &PageRecording::label, "64 min, XY CCW"}, Field{"trace", &PageRecording::trace, ""}});
};

template <>
struct ResultType<Compared> {
  static constexpr std::string_view name = "ResultRow";
  static constexpr std::string_view meaning = "A result, ours beside what the file stores.";
  static constexpr std::tuple fields{
      Field{"label", &Compared::label, ""},
      Field{"decimals", &Compared::decimals, "to show"},
      Field{"ours", &Compared::ours, ""},
      Field{"stored", &Compared::stored, ""},
      Field{"limits",
            [](const Compared& of) {
              using Limits = std::vector<std::optional<double>>;
              return MayLack<Limits>{of.judgement ? std::optional(Limits{of.limits.lower, of.limits.upper})
                                                  : std::nullopt};
            },
            "of the file, lower and upper"},
      Field{"judgement", [](const Compared& of) { return MayLack<Judgement>{of.judgement}; }, "of ours by these"}};
};

struct ResultTable {
  std::string of;
  std::vector<Compared> rows;
};

template <>
struct ResultType<ResultTable> {
  static constexpr std::string_view name = "ResultTable";
  static constexpr std::string_view meaning = "The results of a recording or a pair.";
  static constexpr std::tuple fields{Field{"of", &ResultTable::of, ""}, Field{"rows", &ResultTable::rows, ""}};
};

struct FitPart {
  std::vector<PageRecording> recordings;
  std::vector<ResultTable> results;
  std::vector<std::string> remarks;
  std::vector<std::vector<std::size_t>> pairs;
  MayLack<std::vector<ResultsAlone>> stored_alone;
  std::vector<FittedPair> iso230_4;
};

template <>
struct ResultType<FitPart> {
  static constexpr std::string_view name = "FitPart";
  static constexpr std::string_view meaning = "Recordings and their circles.";
  static constexpr std::tuple fields =
      std::tuple_cat(std::tuple{Field{"recordings", &FitPart::recordings, ""},
                                Field{"results", &FitPart::results, "tables, one a recording and one a pair"},
                                Field{"remarks", &FitPart::remarks, ""},
                                Field{"pairs", &FitPart::pairs, "CCW and CW of one test, as places in recordings"},
                                Field{"stored_alone", &FitPart::stored_alone, "files without readings"}},
                     fields_through(&FitPart::iso230_4, kPairFields));
};

// The errors of a machine from one test.
struct MachineErrorsOfTest {
  ErrorsReport report;
  std::vector<std::string> files;
  std::vector<std::size_t> recordings;
  std::vector<Bulk> circle_um;
  TableOf<std::vector<Bulk>> curves;
};

template <>
struct ResultType<MachineErrorsOfTest> {
  using Report = ResultType<ErrorsReport>;
  static constexpr std::string_view name = "MachineErrorsPart";
  static constexpr std::string_view meaning = "The errors of a machine from one test, with their curves.";
  static constexpr std::tuple fields = std::tuple_cat(
      std::tuple{Field{"files", &MachineErrorsOfTest::files, ""}},
      fields_through(&MachineErrorsOfTest::report, Report::driven),
      std::tuple{Field{"recordings", &MachineErrorsOfTest::recordings, "places in the recordings of the page"}},
      fields_through(&MachineErrorsOfTest::report, Report::rest),
      std::tuple{Field{"circle_um", &MachineErrorsOfTest::circle_um,
                       "at the readings of each recording: centre and scale of all together"},
                 Field{"curves", &MachineErrorsOfTest::curves, "by effect: what it adds"}});
};

struct ProbesAxis {
  std::string name, unit;
  Bulk values, sigma;
};

template <>
struct ResultType<ProbesAxis> {
  static constexpr std::string_view name = "ProbesAxis";
  static constexpr std::string_view meaning = "An axis as five probes have it.";
  static constexpr std::tuple fields{Field{"name", &ProbesAxis::name, ""}, Field{"unit", &ProbesAxis::unit, ""},
                                     Field{"values", &ProbesAxis::values, ""}, Field{"sigma", &ProbesAxis::sigma, ""}};
};

struct ProbesPart {
  std::string what;
  double reference_s = 0.0;
  Bulk time_s;
  std::vector<ProbesAxis> axes;
  std::vector<std::string> remarks;
};

template <>
struct ResultType<ProbesPart> {
  static constexpr std::string_view name = "ProbesPart";
  static constexpr std::string_view meaning = "Five probes: axes as columns, because there may be a million rows.";
  static constexpr std::tuple fields{Field{"what", &ProbesPart::what, "the file"},
                                     Field{"reference_s", &ProbesPart::reference_s, ""},
                                     Field{"time_s", &ProbesPart::time_s, ""}, Field{"axes", &ProbesPart::axes, ""},
                                     Field{"remarks", &ProbesPart::remarks, ""}};
};

template <>
struct ResultType<TrainedBatch> {
  static constexpr std::string_view name = "WeighedBatch";
  static constexpr std::string_view meaning = "A batch that a regression was trained on.";
  static constexpr std::tuple fields{Field{"name", &TrainedBatch::name, ""},
                                     Field{"weight", &TrainedBatch::weight, ""}};
};

struct BatchPart {
  std::string target, method;
  std::vector<TrainedBatch> batches;
  Bulk time_s, predicted_um, half_width_um;
  MayLack<Bulk> measured_um;
  Bulk T2_of_largest, Q_of_largest;
  std::vector<std::string> broken, warnings;
};

template <>
struct ResultType<BatchPart> {
  static constexpr std::string_view name = "BatchPart";
  static constexpr std::string_view meaning = "A regression over batches, and what it predicts for the job.";
  static constexpr std::tuple fields{
      Field{"target", &BatchPart::target, ""},
      Field{"method", &BatchPart::method, "pcr, 7 components"},
      Field{"batches", &BatchPart::batches, ""},
      Field{"time_s", &BatchPart::time_s, ""},
      Field{"predicted_um", &BatchPart::predicted_um, ""},
      Field{"half_width_um", &BatchPart::half_width_um, "of the interval of 95 %"},
      Field{"measured_um", &BatchPart::measured_um, ""},
      Field{"T2_of_largest", &BatchPart::T2_of_largest, "share of the largest trained on"},
      Field{"Q_of_largest", &BatchPart::Q_of_largest, ""},
      Field{"broken", &BatchPart::broken, "sensors that look so"},
      Field{"warnings", &BatchPart::warnings, ""}};
};

template <>
struct ResultType<RegimeStretch> {
  static constexpr std::string_view name = "RegimeStretch";
  static constexpr std::string_view meaning = "A stretch of time with one regime of the speed.";
  static constexpr std::tuple fields{Field{"regime", &RegimeStretch::regime, ""},
                                     Field{"from_s", &RegimeStretch::from_s, ""},
                                     Field{"to_s", &RegimeStretch::to_s, ""}};
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
  static constexpr std::tuple fields{Field{"time_s", &CheckedSeries::time_s, ""},
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
  static constexpr std::tuple fields{Field{"time_s", &ModelCurve::time_s, ""},
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
                                     Field{"from", &EffectStep::from, ""},
                                     Field{"to", &EffectStep::to, ""},
                                     Field{"unit", &EffectStep::unit, ""},
                                     Field{"time_s", &EffectStep::time_s, ""},
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
                 Field{"best_surrogate_fall", [](const PageCandidate& of) { return of.candidate.best_surrogate_fall; },
                       "share of the RMSE beside the rest of its set"},
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
      "Which effect (column) could be taken for one that might be there (row): above 0.95 it may be.";
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
      fields_through(&DiagnosisPart::report, std::tuple_cat(of_check, Report::told)),
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

// What of a report changes with the model.
struct ModelPart {
  std::vector<std::string> files, summary;
  MayLack<FitPart> fit;
  MayLack<CheckParts> check;
  MayLack<DiagnosisParts> diagnose;
  MayLack<Ledger> ledger;
};

template <>
struct ResultType<ModelPart> {
  static constexpr std::string_view name = "ModelPart";
  static constexpr std::string_view meaning = "What of a page changes with the model.";
  static constexpr std::tuple drawn{Field{"check", &ModelPart::check, "how it fits"},
                                    Field{"diagnose", &ModelPart::diagnose, "what it lacks"},
                                    Field{"ledger", &ModelPart::ledger, "of the model"}};
  static constexpr std::tuple fields =
      std::tuple_cat(std::tuple{Field{"files", &ModelPart::files, "that the page is made of"},
                                Field{"summary", &ModelPart::summary, "the conclusions"},
                                Field{"fit", &ModelPart::fit, "of recordings, with what each effect adds"}},
                     drawn);
};

struct PageReport {
  ReportHead head;
  MayLack<FitPart> fit;
  MayLack<std::vector<MachineErrorsOfTest>> machine_errors;
  MayLack<std::vector<SkippedFile>> skipped;
  MayLack<DriftSeries> drift;
  MayLack<ProbesPart> five_probe;
  MayLack<Comparison> compare;
  ModelPart model;
  MayLack<BatchPart> batch;
};

template <>
struct ResultType<PageReport> {
  static constexpr std::string_view name = "Report";
  static constexpr std::string_view meaning = "The data of a page.";
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&PageReport::head, ResultType<ReportHead>::fields),
      std::tuple{Field{"fit", &PageReport::fit, "of recordings"},
                 Field{"machine_errors", &PageReport::machine_errors, "one a test"},
                 Field{"skipped", &PageReport::skipped, "files that cannot be read, by their names"},
                 Field{"drift", &PageReport::drift, "of a session"}, Field{"five_probe", &PageReport::five_probe, ""},
                 Field{"compare", &PageReport::compare, "of two drifts"}},
      fields_through(&PageReport::model, ResultType<ModelPart>::drawn),
      std::tuple{Field{"batch", &PageReport::batch, "with a model of train"}});
};

// What a page is told of steps that it asks for.
struct HeldPart {
  CheckParts check;
};

template <>
struct ResultType<HeldPart> {
  static constexpr std::string_view name = "HeldPart";
  static constexpr std::string_view meaning = "A model with values held.";
  static constexpr std::tuple fields{Field{"check", &HeldPart::check, "how it fits"}};
};

struct RevisedPart {
  std::string sentence;
  bool supported = false;
  Ledger ledger;
};

template <>
struct ResultType<RevisedPart> {
  static constexpr std::string_view name = "RevisedPart";
  static constexpr std::string_view meaning = "A new revision of a model.";
  static constexpr std::tuple fields{Field{"sentence", &RevisedPart::sentence, "what it says in plain words"},
                                     Field{"supported", &RevisedPart::supported, "whether the data support it"},
                                     Field{"ledger", &RevisedPart::ledger, ""}};
};

}  // namespace ballbar
