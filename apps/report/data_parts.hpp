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
inline constexpr auto kResult<EffectCurve> =
    ResultType{"EffectCurve", "What an effect adds.",
               std::tuple{Field{"effect", &EffectCurve::effect, "with its columns"},
                          Field{"values_um", &EffectCurve::values_um, ""}}};

// The curves of a recording.
struct Trace {
  Bulk angle_deg, deviation_um, residual_um, fitted_um;
  std::vector<EffectCurve> effects;
  MayLack<Bulk> time_s;
};

template <>
inline constexpr auto kResult<Trace> = ResultType{
    "Trace", "The readings of a recording, and what was fitted.",
    std::tuple{Field{"angle_deg", known(&Trace::angle_deg), "of a circle"},
               Field{"deviation_um", known(&Trace::deviation_um), "measured length less nominal"},
               Field{"residual_um", known(&Trace::residual_um), "reading less what was fitted"},
               Field{"fitted_um", known(&Trace::fitted_um), "deviation of what was fitted, at the same readings"},
               Field{"effects", &Trace::effects, "what each effect of a model adds"},
               Field{"time_s", known(&Trace::time_s), "of an axial one"}}};

struct PageRecording {
  FittedRecording fitted;
  std::optional<double> time_s;
  std::string test, label;
  Trace trace;
};

template <>
inline constexpr auto kResult<PageRecording> = ResultType{
    "PageRecording", "A recording with its curves.",
    std::tuple_cat(fields_through(&PageRecording::fitted, kResult<FittedRecording>.fields),
                   std::tuple{Field{"time_s", &PageRecording::time_s, "of the test in its session; null: of none"},
                              Field{"test", &PageRecording::test, "64 min, or the file"},
                              Field{"label", &PageRecording::label, "64 min, XY CCW"},
                              Field{"trace", &PageRecording::trace, ""}})};

template <>
inline constexpr auto kResult<Compared> = ResultType{
    "ResultRow", "A result, ours beside what the file stores.",
    std::tuple{
        Field{"key", &Compared::key, "g_ccw_um, d_um, ...; empty: of no number of ISO 230-4"},
        Field{"label", &Compared::label, ""}, Field{"decimals", &Compared::decimals, "to show"},
        Field{"ours", &Compared::ours, ""}, Field{"stored", &Compared::stored, ""},
        Field{"limits",
              [](const Compared& of) {
                using Limits = std::vector<std::optional<double>>;
                return MayLack<Limits>{of.judgement ? std::optional(Limits{of.limits.lower, of.limits.upper})
                                                    : std::nullopt};
              },
              "of the file, lower and upper"},
        Field{"judgement", [](const Compared& of) { return MayLack<Judgement>{of.judgement}; }, "of ours by these"}}};

struct ResultTable {
  std::string of;
  std::vector<Compared> rows;
};

template <>
inline constexpr auto kResult<ResultTable> =
    ResultType{"ResultTable", "The results of a recording or a pair.",
               std::tuple{Field{"of", &ResultTable::of, ""}, Field{"rows", &ResultTable::rows, ""}}};

struct FitPart {
  std::vector<PageRecording> recordings;
  std::vector<ResultTable> results;
  std::vector<std::string> remarks;
  std::vector<std::vector<std::size_t>> pairs;
  MayLack<std::vector<ResultsAlone>> stored_alone;
  std::vector<FittedPair> iso230_4;
};

template <>
inline constexpr auto kResult<FitPart> = ResultType{
    "FitPart", "Recordings and their circles.",
    std::tuple_cat(std::tuple{Field{"recordings", &FitPart::recordings, ""},
                              Field{"results", &FitPart::results, "tables, one a recording and one a pair"},
                              Field{"remarks", &FitPart::remarks, ""},
                              Field{"pairs", &FitPart::pairs, "CCW and CW of one test, as places in recordings"},
                              Field{"stored_alone", &FitPart::stored_alone, "files without readings"}},
                   fields_through(&FitPart::iso230_4, kPairFields))};

// What the catalogue says of an error, with the machine's axes.
struct ErrorPage {
  const Effect* effect = nullptr;
  Plane plane = Plane::XY;
};

template <>
inline constexpr auto kResult<ErrorPage> = ResultType{
    "ErrorPage", "What the catalogue says of an error, with the machine's axes.",
    std::tuple{Field{"effect", [](const ErrorPage& of) { return of.effect->name; }, ""},
               Field{"summary", [](const ErrorPage& of) { return with_axes(of.effect->explanation.summary, of.plane); },
                     "in a line"},
               Field{"cause", [](const ErrorPage& of) { return of.effect->explanation.cause; }, ""},
               Field{"signature", [](const ErrorPage& of) { return of.effect->explanation.signature; }, "how it looks"},
               Field{"confused_with", [](const ErrorPage& of) { return of.effect->explanation.confused_with; },
                     "other effects"},
               Field{"separated_by", [](const ErrorPage& of) { return of.effect->explanation.separated_by; },
                     "the test that tells them apart"},
               Field{"remedy", [](const ErrorPage& of) { return of.effect->explanation.remedy; }, "in the workshop"}}};

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
inline constexpr auto kResult<MachineErrorsOfTest> = ResultType{
    "MachineErrorsPart", "The errors of a machine from one test, with their curves.",
    std::tuple_cat(
        std::tuple{Field{"files", &MachineErrorsOfTest::files, ""}},
        fields_through(&MachineErrorsOfTest::report, kErrorsReportDriven),
        std::tuple{Field{"recordings", &MachineErrorsOfTest::recordings, "places in the recordings of the page"}},
        fields_through(&MachineErrorsOfTest::report, kErrorsReportRest),
        std::tuple{Field{"circle_um", &MachineErrorsOfTest::circle_um,
                         "at the readings of each recording: centre and scale of all together"},
                   Field{"curves", &MachineErrorsOfTest::curves, "by effect: what it adds"},
                   Field{"pages", &MachineErrorsOfTest::pages, "of the errors that are ranked"}})};

// Of each row.
Bulk sigmas_of(const DriftAxis& axis);
// Its values at these rows.
std::vector<double> at_rows(const std::vector<double>& values, const std::vector<std::size_t>& rows);

template <>
inline constexpr auto kResult<DriftAxis> =
    ResultType{"ProbesAxis", "An axis as five probes have it.",
               std::tuple{Field{"name", &DriftAxis::name, ""}, Field{"unit", &DriftAxis::unit, ""},
                          Field{"values", [](const DriftAxis& of) { return Bulk{of.value}; }, ""},
                          Field{"sigma", &sigmas_of, ""}}};

template <>
inline constexpr auto kResult<MeasuredDrift> =
    ResultType{"ProbesPart", "Five probes: axes as columns, because there may be a million rows.",
               std::tuple{Field{"what", &MeasuredDrift::what, "the file"},
                          Field{"reference_s", known(&MeasuredDrift::reference_s), ""},
                          Field{"time_s", [](const MeasuredDrift& of) { return Known<Bulk>{{of.time_s}}; }, ""},
                          Field{"axes", &MeasuredDrift::axes, ""}, Field{"remarks", &MeasuredDrift::remarks, ""}}};

template <>
inline constexpr auto kResult<TrainedBatch> =
    ResultType{"WeighedBatch", "A batch that a regression was trained on.",
               std::tuple{Field{"name", &TrainedBatch::name, ""}, Field{"weight", known(&TrainedBatch::weight), ""}}};

template <>
inline constexpr auto kResult<BatchJob> = ResultType{
    "BatchPart", "A regression over batches, and what it predicts for the job.", std::tuple{
      Field{"target", [](const BatchJob& of) { return of.job.target; }, ""},
      Field{"method", [](const BatchJob& of) { return label_of(of.model.settings); }, "pcr, 7 components"},
      Field{"batches", [](const BatchJob& of) { return of.model.batches; }, ""},
      Field{"time_s", [](const BatchJob& of) { return Known<Bulk>{{of.job.data.time_s}}; }, ""},
      Field{"predicted_um", [](const BatchJob& of) { return Bulk{of.job.prediction.predicted_um}; }, ""},
      Field{"half_width_um", [](const BatchJob& of) { return Bulk{of.job.prediction.half_width_um}; },
            "of the interval of 95 %"},
      Field{"measured_um",
            [](const BatchJob& of) {
              const Column* const measured = find_column(of.job.data, of.job.target);
              return MayLack<Bulk>{measured == nullptr ? std::nullopt : std::optional(Bulk{measured->values})};
            },
            ""},
      Field{"T2_of_largest", [](const BatchJob& of) { return Bulk{of.job.prediction.T2_of_largest}; },
            "share of the largest trained on"},
      Field{"Q_of_largest", [](const BatchJob& of) { return Bulk{of.job.prediction.Q_of_largest}; }, ""},
      Field{"broken", [](const BatchJob& of) { return of.job.prediction.broken; }, "sensors that look so"},
      Field{"warnings", [](const BatchJob& of) { return of.job.warnings; }, ""}}};

}  // namespace ballbar
