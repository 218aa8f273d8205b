// The parts of a page that are of a model beside data.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "report/data_parts.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<RegimeStretch> = ResultType("RegimeStretch",
                                                          "A stretch of time with one regime of the speed.",
                                                          Field{"regime", &RegimeStretch::regime},
                                                          Field{"from_s", known(&RegimeStretch::from_s)},
                                                          Field{"to_s", known(&RegimeStretch::to_s)});

struct CheckedSeries {
  Bulk time_s, measured_um, predicted_um, residual_um;
  std::optional<Bulk> sigma_um;
  std::vector<EffectCurve> contributions;
  std::vector<PageColumn> inputs;
  std::vector<RegimeStretch> regimes;
};

template <>
inline constexpr auto kResult<CheckedSeries> = ResultType(
    "CheckedSeries", "The rows of a fit.", Field{"time_s", known(&CheckedSeries::time_s)},
    Field{"measured_um", &CheckedSeries::measured_um}, Field{"predicted_um", &CheckedSeries::predicted_um},
    Field{"residual_um", &CheckedSeries::residual_um},
    Field{"sigma_um", may_lack(&CheckedSeries::sigma_um), "where readings state it"},
    Field{"contributions", &CheckedSeries::contributions, "of each effect"},
    Field{"inputs", &CheckedSeries::inputs, "at the same rows: signals, or angle_deg, direction, recording; and cycle"},
    Field{"regimes", &CheckedSeries::regimes, "of the speed, where it is known"});

struct ModelCurve {
  Bulk time_s, predicted_um;
};

template <>
inline constexpr auto kResult<ModelCurve> = ResultType("ModelCurve", "A model over time.",
                                                       Field{"time_s", known(&ModelCurve::time_s)},
                                                       Field{"predicted_um", &ModelCurve::predicted_um});

struct EffectStep {
  std::string effect, input;
  double from = 0.0, to = 0.0;
  std::string unit;
  Bulk time_s, response_um;
};

template <>
inline constexpr auto kResult<EffectStep> = ResultType(
    "EffectStep", "What an effect answers to a step of its input from the least to the largest value in the data.",
    Field{"effect", &EffectStep::effect}, Field{"input", &EffectStep::input}, Field{"from", known(&EffectStep::from)},
    Field{"to", known(&EffectStep::to)}, Field{"unit", &EffectStep::unit}, Field{"time_s", known(&EffectStep::time_s)},
    Field{"response_um", &EffectStep::response_um});

struct CheckPart {
  ResidualReport report;
  std::string level;
  Paragraph floor_text;
  CheckedSeries series;
  std::optional<ModelCurve> curve;
  std::vector<EffectStep> steps;
};

template <>
inline constexpr auto kResult<CheckPart> =
    ResultType("CheckPart", "A model fitted, with its curves.", fields_of(&CheckPart::report),
               Field{"level", &CheckPart::level, "series, recording"}, Field{"floor_text", &CheckPart::floor_text},
               Field{"series", &CheckPart::series},
               Field{"curve", may_lack(&CheckPart::curve), "the model between the rows too, where signals go on there"},
               Field{"steps", &CheckPart::steps, "of a drift series only"});

struct PageCandidate {
  Candidate candidate;
  Bulk curve_um;
};

template <>
inline constexpr auto kResult<PageCandidate> =
    ResultType("DrawnCandidate", "An effect that may be missing, with its curve.", fields_of(&PageCandidate::candidate),
               Field{"curve_um", &PageCandidate::curve_um,
                     "what it adds that the model cannot make itself, at the rows of the checked series"});

struct Coherence {
  std::vector<std::string> effects;
  std::vector<std::vector<double>> values;
};

// |cos| between what survives of both beside the model, the median over the shapes of the row, each with the shape of
// the column that is most like it. Not symmetric: one with more shapes imitates more.
template <>
inline constexpr auto kResult<Coherence> = ResultType(
    "Coherence", "Which effect (column) could be confused with one that might be there (row): possible above 0.95.",
    Field{"effects", &Coherence::effects}, Field{"values", &Coherence::values});

struct DiagnosisPart {
  DiagnosisReport report;
  std::vector<PageCandidate> candidates;
  Bulk refit_um;
  std::optional<Coherence> coherence;
};

template <>
inline constexpr auto kResult<DiagnosisPart> = ResultType(
    "DiagnosisPart", "Which effect a model lacks, with curves; what the check has is there alone.",
    fields_of(&DiagnosisPart::report, fields_of(&DiagnosisReport::residual_report, kResidualReportFigures, kConverged),
              kDiagnosisFields),
    Field{"candidates", &DiagnosisPart::candidates, "the likeliest set, then others by probability"},
    Field{"rmse_after_um", in(&DiagnosisPart::report, of_diagnosis(&Diagnosis::rmse_after_um)), "with the best set"},
    Field{"next_test_text", in(&DiagnosisPart::report, &next_test), "as the terminal has it; empty: none is needed"},
    Field{"hint", in(&DiagnosisPart::report, &DiagnosisReport::hint), "what no command does; empty: nothing"},
    Field{"refit_um", &DiagnosisPart::refit_um,
          "by what the model's own parameters give way beside what is missing, at the same rows"},
    Field{"coherence", &DiagnosisPart::coherence, "null: nothing to compare"});

template <>
inline constexpr std::string_view kTargetsName<CheckPart> = "CheckParts";

template <>
inline constexpr std::string_view kTargetsName<std::variant<DiagnosisPart, NotDiagnosed>> = "DiagnosisParts";

}  // namespace ballbar
