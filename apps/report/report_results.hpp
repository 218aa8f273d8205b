// The data of a page, whole and in the parts that it asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/series/series.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/revision_results.hpp"
#include "errors/test_results.hpp"
#include "errors/test_table.hpp"
#include "measure/comparison_result.hpp"
#include "measure/fit_result.hpp"
#include "model/residual_report.hpp"
#include "report/model_parts.hpp"

namespace ballbar {

// The parts of a report that change with the model.
struct ModelPart {
  std::vector<std::string> files;
  std::vector<Paragraph> summary;
  std::optional<FitPart> fit;
  std::optional<Targets<CheckPart>> check;
  std::optional<Targets<std::variant<DiagnosisPart, NotDiagnosed>>> diagnose;
  std::optional<Ledger> ledger;
};

inline constexpr FieldList kModelPartDrawn{Field{"check", may_lack(&ModelPart::check), "how it fits"},
                                           Field{"diagnose", may_lack(&ModelPart::diagnose), "what it lacks"},
                                           Field{"ledger", may_lack(&ModelPart::ledger), "of the model"}};

template <>
inline constexpr auto kResult<ModelPart> = ResultType("ModelPart", "What of a page changes with the model.",
                                                      Field{"files", &ModelPart::files, "that the page is made of"},
                                                      Field{"summary", &ModelPart::summary, "the conclusions"},
                                                      Field{"fit", may_lack(&ModelPart::fit),
                                                            "of recordings, with what each effect adds"},
                                                      kModelPartDrawn);

// Two tests, before and after; of the errors of each the place in machine_errors.
struct ComparedTests {
  TestComparison comparison;
  std::optional<std::size_t> before_place, after_place;
};

template <>
inline constexpr auto kResult<ComparedTests> = ResultType("ComparedTests",
                                                          "Two tests of a plane, before and after, with their errors.",
                                                          fields_of(&ComparedTests::comparison),
                                                          Field{"before_place", &ComparedTests::before_place,
                                                                "in machine_errors; null: only stored results"},
                                                          Field{"after_place", &ComparedTests::after_place});

struct PageReport {
  ReportHead head;
  std::optional<FitPart> fit;
  std::optional<std::vector<MachineErrorsOfTest>> machine_errors;
  std::optional<std::vector<ComparedTests>> test_comparisons;
  std::optional<std::vector<SkippedFile>> skipped;
  std::optional<DriftSeries> drift;
  std::optional<MeasuredDrift> five_probe;
  std::optional<DriftSheet> thermal;
  std::optional<Comparison> compare;
  ModelPart model;
  std::optional<BatchJob> batch;
};

template <>
inline constexpr auto kResult<PageReport> = ResultType(
    "Report", "The data of a page.", fields_of(&PageReport::head),
    Field{"fit", may_lack(&PageReport::fit), "of recordings"},
    Field{"machine_errors", may_lack(&PageReport::machine_errors), "one a test"},
    Field{"test_comparisons", may_lack(&PageReport::test_comparisons), "one a plane"},
    Field{"skipped", may_lack(&PageReport::skipped), "files that cannot be read, by their names"},
    Field{"drift", may_lack(&PageReport::drift), "of a session"},
    Field{"five_probe", may_lack(&PageReport::five_probe)},
    Field{"thermal", may_lack(&PageReport::thermal), "the sheet of a thermal test, without a model"},
    Field{"compare", may_lack(&PageReport::compare), "of two drifts"}, fields_of(&PageReport::model, kModelPartDrawn),
    Field{"batch", may_lack(&PageReport::batch), "with a model of train"});

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
inline constexpr auto kResult<TestRow> = ResultType(
    "TestRow", "A test in the table of all.", fields_of(&TestRow::test, kMachineTestMadeWith),
    Field{"numbers", &TestRow::numbers, "of ISO 230-4, of one direction its circularity"},
    Field{"both_runs", [](const TestRow& of) { return known_quantity(quantity_of(of.test, "circularity")); },
          "largest less smallest reading of both directions about one centre, or as stored"},
    Field{"largest", [](const TestRow& of) { return known_quantity(first_to_mend(of.test)); },
          "error to correct first; null: none"},
    Field{"passes", &TestRow::passes, "by the tolerance and the limits in the file; null: neither is known"});

struct TestRows {
  std::vector<TestRow> tests;
  std::vector<SkippedTest> skipped;
  std::vector<std::string> remarks;
  std::optional<double> tolerance_um;
};

template <>
inline constexpr auto kResult<TestRows> = ResultType(
    "TestRows", "All ballbar tests of a folder.", Field{"tests", &TestRows::tests, "one row per test"},
    Field{"skipped", &TestRows::skipped, "files that could not be read"},
    Field{"remarks", &TestRows::remarks, "of the readers"},
    Field{"tolerance_um", &TestRows::tolerance_um, "of the circularity of both directions; null: none was given"});

struct TestsReport {
  ReportHead head;
  TestRows rows;
};

template <>
inline constexpr auto kResult<TestsReport> = ResultType("TestsReport", "The data of a page of all tests of a folder.",
                                                        fields_of(&TestsReport::head),
                                                        Field{"test_table", &TestsReport::rows});

// All tests of the files, fitted. `title`: of the folder.
TestsReport tests_report(const std::string& title, const std::vector<std::string>& files, const StatedCircle& stated);

// The same by a tolerance of the circularity; nullopt: by the limits in the files alone.
TestsReport judged(TestsReport report, std::optional<double> tolerance_um);

template <>
inline constexpr auto kResult<SignalGap> = ResultType("SignalGap", "A stretch without values of a signal.",
                                                      Field{"signal", &SignalGap::signal, "column"},
                                                      Field{"from_s", &SignalGap::from_s},
                                                      Field{"to_s", &SignalGap::to_s});

struct RevisedPart {
  Paragraph sentence;
  bool supported = false, kept = false;
  Ledger ledger;
};

template <>
inline constexpr auto kResult<RevisedPart> = ResultType(
    "RevisedPart", "A new revision of a model.",
    Field{"sentence", &RevisedPart::sentence, "what it says in plain words"},
    Field{"supported", &RevisedPart::supported, "whether the data support it"},
    Field{"kept", &RevisedPart::kept, "whether the model has it now"}, Field{"ledger", &RevisedPart::ledger});

// An effect that can be added to a model, with each choice of columns; none: no column suits.
struct EffectChoice {
  std::string effect;
  std::vector<std::vector<std::string>> columns;
  std::vector<std::string> labels;
};

template <>
inline constexpr auto kResult<EffectChoice> = ResultType(
    "EffectChoice", "An effect that may be added to a model, with the columns that suit.",
    Field{"effect", &EffectChoice::effect},
    Field{"columns", &EffectChoice::columns,
          "each choice, in the order of the effect's inputs; on recordings, and of time alone, an empty one"},
    Field{"labels", &EffectChoice::labels, "as add takes them, choice by choice"});

// The fit of a model with possibly missing effects.
struct FittedHypothesis {
  std::vector<std::string> effects;
  Targets<CheckPart> check;
  LedgerEntry row;
};

template <>
inline constexpr auto kResult<FittedHypothesis> =
    ResultType("FittedHypothesis", "A model with effects that might be missing.",
               Field{"effects", &FittedHypothesis::effects, "that are added; none: the model as it is"},
               Field{"check", &FittedHypothesis::check, "how it fits"},
               Field{"row", &FittedHypothesis::row, "as the ledger would have it"});

struct Hypotheses {
  std::vector<FittedHypothesis> hypotheses;
  std::vector<double> p;
};

template <>
inline constexpr auto kResult<Hypotheses> =
    ResultType("Hypotheses", "Models side by side.", Field{"hypotheses", &Hypotheses::hypotheses},
               Field{"p", &Hypotheses::p, "of each against the others, alike before the readings; null: not known"});

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
  std::vector<Paragraph> conclusions;  // one a test
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
