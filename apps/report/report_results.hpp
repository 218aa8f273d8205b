// The data of a page, whole and in the parts that it asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/drift/measured_drift.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/series/series.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/revision_results.hpp"
#include "errors/test_comparison_result.hpp"
#include "errors/test_result.hpp"
#include "errors/test_table.hpp"
#include "measure/comparison_result.hpp"
#include "measure/fit_result.hpp"
#include "model/residual_report.hpp"
#include "report/model_parts.hpp"

namespace ballbar {

// The parts of a report that change with the model.
struct ModelPart {
  std::vector<std::string> files, summary;
  MayLack<FitPart> fit;
  MayLack<CheckParts> check;
  MayLack<DiagnosisParts> diagnose;
  MayLack<Ledger> ledger;
};

inline constexpr auto kModelPartDrawn = std::tuple{Field{"check", &ModelPart::check, "how it fits"},
                                                   Field{"diagnose", &ModelPart::diagnose, "what it lacks"},
                                                   Field{"ledger", &ModelPart::ledger, "of the model"}};

template <>
inline constexpr auto kResult<ModelPart> =
    ResultType{"ModelPart", "What of a page changes with the model.",
               std::tuple_cat(std::tuple{Field{"files", &ModelPart::files, "that the page is made of"},
                                         Field{"summary", &ModelPart::summary, "the conclusions"},
                                         Field{"fit", &ModelPart::fit, "of recordings, with what each effect adds"}},
                              kModelPartDrawn)};

// Two tests, before and after; of the errors of each the place in machine_errors.
struct ComparedTests {
  TestComparison comparison;
  std::optional<std::size_t> before_place, after_place;
};

template <>
inline constexpr auto kResult<ComparedTests> = ResultType{
    "ComparedTests", "Two tests of a plane, before and after, with their errors.",
    std::tuple_cat(
        fields_through(&ComparedTests::comparison, kResult<TestComparison>.fields),
        std::tuple{Field{"before_place", &ComparedTests::before_place, "in machine_errors; null: only stored results"},
                   Field{"after_place", &ComparedTests::after_place, ""}})};

struct PageReport {
  ReportHead head;
  MayLack<FitPart> fit;
  MayLack<std::vector<MachineErrorsOfTest>> machine_errors;
  MayLack<std::vector<ComparedTests>> test_comparisons;
  MayLack<std::vector<SkippedFile>> skipped;
  MayLack<DriftSeries> drift;
  MayLack<MeasuredDrift> five_probe;
  MayLack<DriftSheet> thermal;
  MayLack<Comparison> compare;
  ModelPart model;
  MayLack<BatchJob> batch;
};

template <>
inline constexpr auto kResult<PageReport> = ResultType{
    "Report", "The data of a page.",
    std::tuple_cat(
        fields_through(&PageReport::head, kResult<ReportHead>.fields),
        std::tuple{Field{"fit", &PageReport::fit, "of recordings"},
                   Field{"machine_errors", &PageReport::machine_errors, "one a test"},
                   Field{"test_comparisons", &PageReport::test_comparisons, "one a plane"},
                   Field{"skipped", &PageReport::skipped, "files that cannot be read, by their names"},
                   Field{"drift", &PageReport::drift, "of a session"}, Field{"five_probe", &PageReport::five_probe, ""},
                   Field{"thermal", &PageReport::thermal, "the sheet of a thermal test, without a model"},
                   Field{"compare", &PageReport::compare, "of two drifts"}},
        fields_through(&PageReport::model, kModelPartDrawn),
        std::tuple{Field{"batch", &PageReport::batch, "with a model of train"}})};

// A test as a row of the table of all.
struct TestRow {
  MachineTest test;
  std::vector<Compared> numbers;  // of ISO 230-4, or of its only direction; fitted, or stored
  std::optional<bool> passes;
};

inline std::optional<TestQuantity> known_quantity(const TestQuantity* one) {
  return one == nullptr ? std::nullopt : std::optional(*one);
}

template <>
inline constexpr auto kResult<TestRow> = ResultType{
    "TestRow", "A test in the table of all.",
    std::tuple_cat(
        fields_through(&TestRow::test, kMachineTestMadeWith),
        std::tuple{
            Field{"numbers", &TestRow::numbers, "of ISO 230-4, of one direction its circularity"},
            Field{"both_runs", [](const TestRow& of) { return known_quantity(quantity_of(of.test, "circularity")); },
                  "largest less smallest reading of both directions about one centre, or as stored"},
            Field{"largest", [](const TestRow& of) { return known_quantity(first_to_mend(of.test)); },
                  "error to correct first; null: none"},
            Field{"passes", &TestRow::passes, "by the tolerance and the limits in the file; null: neither is known"}})};

struct TestRows {
  std::vector<TestRow> tests;
  std::vector<SkippedTest> skipped;
  std::vector<std::string> remarks;
  std::optional<double> tolerance_um;
};

template <>
inline constexpr auto kResult<TestRows> =
    ResultType{"TestRows", "All ballbar tests of a folder.",
               std::tuple{Field{"tests", &TestRows::tests, "one row per test"},
                          Field{"skipped", &TestRows::skipped, "files that could not be read"},
                          Field{"remarks", &TestRows::remarks, "of the readers"},
                          Field{"tolerance_um", &TestRows::tolerance_um,
                                "of the circularity of both directions; null: none was given"}}};

struct TestsReport {
  ReportHead head;
  TestRows rows;
};

template <>
inline constexpr auto kResult<TestsReport> =
    ResultType{"TestsReport", "The data of a page of all tests of a folder.",
               std::tuple_cat(fields_through(&TestsReport::head, kResult<ReportHead>.fields),
                              std::tuple{Field{"test_table", &TestsReport::rows, ""}})};

// All tests of the files, fitted. `title`: of the folder.
TestsReport tests_report(const std::string& title, const std::vector<std::string>& files, const StatedCircle& stated);

// The same by a tolerance of the circularity; nullopt: by the limits in the files alone.
TestsReport judged(TestsReport report, std::optional<double> tolerance_um);

// Results of the steps that a page requests.
struct HeldPart {
  CheckParts check;
};

template <>
inline constexpr auto kResult<HeldPart> =
    ResultType{"HeldPart", "A model with values held.", std::tuple{Field{"check", &HeldPart::check, "how it fits"}}};

struct SignalGaps {
  std::optional<SignalGap> gap;
};

template <>
inline constexpr auto kResult<SignalGap> =
    ResultType{"SignalGap", "A stretch without values of a signal.",
               std::tuple{Field{"signal", &SignalGap::signal, "column"}, Field{"from_s", &SignalGap::from_s, ""},
                          Field{"to_s", &SignalGap::to_s, ""}}};

template <>
inline constexpr auto kResult<SignalGaps> =
    ResultType{"SignalGaps", "Gaps that a fit would have to interpolate.",
               std::tuple{Field{"gap", &SignalGaps::gap, "the longest; null: none"}}};

struct WithPart {
  double rmse_um = 0.0;
};

template <>
inline constexpr auto kResult<WithPart> =
    ResultType{"WithPart", "What a model would leave with more effects.",
               std::tuple{Field{"rmse_um", &WithPart::rmse_um, "that `add` leaves"}}};

struct RevisedPart {
  std::string sentence;
  bool supported = false, kept = false;
  Ledger ledger;
};

template <>
inline constexpr auto kResult<RevisedPart> =
    ResultType{"RevisedPart", "A new revision of a model.",
               std::tuple{Field{"sentence", &RevisedPart::sentence, "what it says in plain words"},
                          Field{"supported", &RevisedPart::supported, "whether the data support it"},
                          Field{"kept", &RevisedPart::kept, "whether the model has it now"},
                          Field{"ledger", &RevisedPart::ledger, ""}}};

// An effect that can be added to a model, with each choice of columns.
struct EffectChoice {
  std::string name;
  std::vector<BoundEffect> choices;  // none: no column suits
};

template <>
inline constexpr auto kResult<EffectChoice> = ResultType{
    "EffectChoice", "An effect that may be added to a model, with the columns that suit.",
    std::tuple{
        Field{"effect", &EffectChoice::name, ""},
        Field{"columns",
              [](const EffectChoice& of) {
                std::vector<std::vector<std::string>> columns;
                for (const BoundEffect& one : of.choices) columns.push_back(one.columns);
                return columns;
              },
              "each choice, in the order of the effect's inputs; on recordings, and of time alone, an empty one"},
        Field{"labels",
              [](const EffectChoice& of) {
                std::vector<std::string> labels;
                for (const BoundEffect& one : of.choices) labels.push_back(label_of(one));
                return labels;
              },
              "as add takes them, choice by choice"}}};

struct EffectChoices {
  std::vector<EffectChoice> effects;
};

template <>
inline constexpr auto kResult<EffectChoices> =
    ResultType{"EffectChoices", "What may be added to a model.",
               std::tuple{Field{"effects", &EffectChoices::effects, "of the catalogue"}}};

// The fit of a model with possibly missing effects.
struct FittedHypothesis {
  std::vector<std::string> effects;
  CheckParts check;
  LedgerEntry row;
};

template <>
inline constexpr auto kResult<FittedHypothesis> =
    ResultType{"FittedHypothesis", "A model with effects that might be missing.",
               std::tuple{Field{"effects", &FittedHypothesis::effects, "that are added; none: the model as it is"},
                          Field{"check", &FittedHypothesis::check, "how it fits"},
                          Field{"row", &FittedHypothesis::row, "as the ledger would have it"}}};

struct Hypotheses {
  std::vector<FittedHypothesis> hypotheses;
  std::vector<double> p;
};

template <>
inline constexpr auto kResult<Hypotheses> = ResultType{
    "Hypotheses", "Models side by side.",
    std::tuple{Field{"hypotheses", &Hypotheses::hypotheses, ""},
               Field{"p", &Hypotheses::p, "of each against the others, alike before the readings; null: not known"}}};

struct ModelText {
  std::string text;
};

template <>
inline constexpr auto kResult<ModelText> =
    ResultType{"ModelText", "The file of a model.",
               std::tuple{Field{"text", &ModelText::text, "with fitted values to start from"}}};

// What makes the parts.
FitPart recordings_part(const Fitted& fitted);

// With the times of the tests: fitted.recordings are those of session.recordings.
FitPart recordings_part(const Fitted& fitted, const SessionFiles& session);

// What an effect adds to recordings, beside the trace of each: values_um at the rows of a fit to trace_of() the same
// recordings.
void overlay(FitPart& part, const std::string& effect, const std::vector<double>& values_um, const Fit& fit,
             const Series& trace);

// The errors of a machine from each test of two linear axes among these, with the curves that the page draws. One that
// cannot be fitted is a remark.
struct MachineErrorsPart {
  std::vector<MachineErrorsOfTest> tests;
  std::vector<std::string> conclusions;  // one a test
  std::vector<std::string> remarks;
};
MachineErrorsPart machine_errors_part(const Fitted& fitted, const StatedCircle& stated);

// The tests of a plane, those of `after`, by the names of their files, against the others; of several of a plane the
// two that were made most alike. Sentences on those that have no other go to `without`. Throws Error where no two are
// of one plane.
std::vector<ComparedTests> compared_tests_of(const Fitted& fitted, const std::vector<MachineErrorsOfTest>& errors,
                                             const std::vector<std::string>& after, std::vector<std::string>& without);

SignalsPart signals_part(const std::string& source, const Series& series);
CheckPart check_part(const ResidualReport& residual_report, const Model& model, const ModelData& data);
DiagnosisPart diagnosis_part(const DiagnosisReport& diagnosis_report, const ModelData& data);

// What a candidate alone would draw, at the rows of the fit; empty where it cannot be drawn.
std::vector<double> curve_of(const Candidate& candidate, const Fit& fit, const Series& data);

}  // namespace ballbar
