// The parts of a page that are of data: what commands print with --json, and the curves that the page draws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "errors/machine_errors_result.hpp"
#include "errors/quantity_text.hpp"
#include "measure/fit_result.hpp"
#include "page/report_head.hpp"
#include "predict/predicted_job.hpp"

namespace ballbar {

// What an effect adds.
struct EffectCurve {
  std::string effect;
  Bulk values_um;
};

template <>
inline constexpr auto kResult<EffectCurve> = ResultType("EffectCurve", "What an effect adds.",
                                                        Field{"effect", &EffectCurve::effect, "with its columns"},
                                                        Field{"values_um", &EffectCurve::values_um});

// The curves of a recording.
struct Trace {
  Bulk angle_deg, deviation_um, residual_um, fitted_um;
  std::vector<EffectCurve> effects;
  std::optional<Bulk> time_s;
};

template <>
inline constexpr auto kResult<Trace> =
    ResultType("Trace", "The readings of a recording, and what was fitted.",
               Field{"angle_deg", known(&Trace::angle_deg), "of a circle"},
               Field{"deviation_um", known(&Trace::deviation_um), "measured length less nominal"},
               Field{"residual_um", known(&Trace::residual_um), "reading less what was fitted"},
               Field{"fitted_um", known(&Trace::fitted_um), "deviation of what was fitted, at the same readings"},
               Field{"effects", &Trace::effects, "what each effect of a model adds"},
               Field{"time_s", known(may_lack(&Trace::time_s)), "of an axial one"});

struct PageRecording {
  FittedRecording fitted;
  std::optional<double> time_s;
  std::string test, label;
  Trace trace;
};

template <>
inline constexpr auto kResult<PageRecording> =
    ResultType("PageRecording", "A recording with its curves.", fields_of(&PageRecording::fitted),
               Field{"time_s", &PageRecording::time_s, "of the test in its session; null: of none"},
               Field{"test", &PageRecording::test, "64 min, or the file"},
               Field{"label", &PageRecording::label, "64 min, XY CCW"}, Field{"trace", &PageRecording::trace});

inline std::vector<std::optional<double>> limits_of(const Compared& of) { return {of.limits.lower, of.limits.upper}; }

template <>
inline constexpr auto kResult<Compared> =
    ResultType("ResultRow", "A result, ours beside what the file stores.",
               Field{"key", &Compared::key, "g_ccw_um, d_um, ...; empty: of no number of ISO 230-4"},
               Field{"label", &Compared::label}, Field{"decimals", &Compared::decimals, "to show"},
               Field{"ours", &Compared::ours}, Field{"stored", &Compared::stored},
               Field{"limits", where([](const Compared& of) { return of.judgement.has_value(); }, &limits_of),
                     "of the file, lower and upper"},
               Field{"judgement", may_lack(&Compared::judgement), "of ours by these"});

struct ResultTable {
  std::string of;
  std::vector<Compared> rows;
};

template <>
inline constexpr auto kResult<ResultTable> = ResultType("ResultTable", "The results of a recording or a pair.",
                                                        Field{"of", &ResultTable::of},
                                                        Field{"rows", &ResultTable::rows});

struct FitPart {
  std::vector<PageRecording> recordings;
  std::vector<ResultTable> results;
  std::vector<std::string> remarks;
  std::vector<std::vector<std::size_t>> pairs;
  std::optional<std::vector<ResultsAlone>> stored_alone;
  std::vector<FittedPair> iso230_4;
};

template <>
inline constexpr auto kResult<FitPart> = ResultType(
    "FitPart", "Recordings and their circles.", Field{"recordings", &FitPart::recordings},
    Field{"results", &FitPart::results, "tables, one a recording and one a pair"}, Field{"remarks", &FitPart::remarks},
    Field{"pairs", &FitPart::pairs, "CCW and CW of one test, as places in recordings"},
    Field{"stored_alone", may_lack(&FitPart::stored_alone), "files without readings"},
    fields_of(&FitPart::iso230_4, kPairFields));

// What the catalogue says of an error, with the machine's axes.
struct ErrorPage {
  const Effect* effect = nullptr;
  Plane plane = Plane::XY;
};

constexpr auto of_page(auto get) { return in(&ErrorPage::effect, &Effect::explanation, get); }

template <>
inline constexpr auto kResult<ErrorPage> = ResultType(
    "ErrorPage", "What the catalogue says of an error, with the machine's axes.",
    Field{"effect", in(&ErrorPage::effect, &Effect::name)},
    Field{"summary", [](const ErrorPage& of) { return with_axes(of.effect->explanation.summary, of.plane); },
          "in a line"},
    Field{"cause", of_page(&Explanation::cause)}, Field{"signature", of_page(&Explanation::signature), "how it looks"},
    Field{"confused_with", of_page(&Explanation::confused_with), "other effects"},
    Field{"separated_by", of_page(&Explanation::separated_by), "the test that tells them apart"},
    Field{"remedy", of_page(&Explanation::remedy), "in the workshop"});

// The errors of a machine from one test.
struct MachineErrorsOfTest {
  ErrorsReport report;
  std::vector<std::string> files;
  std::vector<std::size_t> recordings;
  std::vector<Bulk> circle_um;
  TableOf<std::vector<Bulk>> curves;
  std::vector<ErrorPage> pages;
};

template <>
inline constexpr auto kResult<MachineErrorsOfTest> =
    ResultType("MachineErrorsPart", "The errors of a machine from one test, with their curves.",
               fields_of(&MachineErrorsOfTest::report), Field{"files", &MachineErrorsOfTest::files},
               Field{"recordings", &MachineErrorsOfTest::recordings, "places in the recordings of the page"},
               Field{"circle_um", &MachineErrorsOfTest::circle_um,
                     "at the readings of each recording: centre and scale of all together"},
               Field{"curves", &MachineErrorsOfTest::curves, "by effect: what it adds"},
               Field{"pages", &MachineErrorsOfTest::pages, "of the errors that are ranked"});

// Of each row.
Bulk sigmas_of(const DriftAxis& axis);
// Its values at these rows.
std::vector<double> at_rows(const std::vector<double>& values, const std::vector<std::size_t>& rows);

template <>
inline constexpr auto kResult<DriftAxis> = ResultType("ProbesAxis", "An axis as five probes have it.",
                                                      Field{"name", &DriftAxis::name}, Field{"unit", &DriftAxis::unit},
                                                      Field{"values", bulk(&DriftAxis::value)},
                                                      Field{"sigma", &sigmas_of});

template <>
inline constexpr auto kResult<MeasuredDrift> = ResultType(
    "ProbesPart", "Five probes: axes as columns, because there may be a million rows.",
    Field{"what", &MeasuredDrift::what, "the file"}, Field{"reference_s", known(&MeasuredDrift::reference_s)},
    Field{"time_s", known(bulk(&MeasuredDrift::time_s))}, Field{"axes", &MeasuredDrift::axes},
    Field{"remarks", &MeasuredDrift::remarks});

template <>
inline constexpr auto kResult<TrainedBatch> = ResultType("WeighedBatch", "A batch that a regression was trained on.",
                                                         Field{"name", &TrainedBatch::name},
                                                         Field{"weight", known(&TrainedBatch::weight)});

constexpr auto of_job(auto... get) { return in(&BatchJob::job, get...); }
constexpr auto of_prediction(auto get) { return of_job(&PredictedJob::prediction, get); }
std::optional<Bulk> measured_of(const PredictedJob& job);

template <>
inline constexpr auto kResult<BatchJob> = ResultType(
    "BatchPart", "A regression over batches, and what it predicts for the job.",
    Field{"target", of_job(&PredictedJob::target)},
    Field{"method", [](const BatchJob& of) { return label_of(of.model.settings); }, "pcr, 7 components"},
    Field{"batches", in(&BatchJob::model, &TemperatureRegression::batches)},
    Field{"time_s", known(bulk(of_job(&PredictedJob::data, &Series::time_s)))},
    Field{"predicted_um", bulk(of_prediction(&RegressionPrediction::predicted_um))},
    Field{"half_width_um", bulk(of_prediction(&RegressionPrediction::half_width_um)), "of the interval of 95 %"},
    Field{"measured_um", may_lack(of_job(&measured_of))},
    Field{"T2_of_largest", bulk(of_prediction(&RegressionPrediction::T2_of_largest)),
          "share of the largest trained on"},
    Field{"Q_of_largest", bulk(of_prediction(&RegressionPrediction::Q_of_largest))},
    Field{"broken", of_prediction(&RegressionPrediction::broken), "sensors that look so"},
    Field{"warnings", of_job(&PredictedJob::warnings)});

}  // namespace ballbar
