// What `diagnose --json` prints of one target.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/formats/results/diagnosis_results.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/diagnosis_sentence.hpp"
#include "diagnose/doubt_text.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<Candidate> = ResultType(
    "Candidate", "An effect that may be missing, beside the rest of its likeliest set.", fields_of(&Candidate::bound),
    Field{"p", &Candidate::p, "probability that it is missing"},
    Field{"likelihood_ratio", &Candidate::likelihood_ratio,
          "2 ln of how much likelier the readings are with it than without"},
    Field{"amplitude_um", &Candidate::amplitude_um, "largest less smallest of what it adds"},
    Field{"amplitude_sigma_um", &Candidate::amplitude_sigma_um, "null: not determined"},
    Field{"rmse_after_um", &Candidate::rmse_after_um, "that the model leaves with it alone, as `add` fits it"},
    Field{"held_out_before_um", &Candidate::held_out_before_um, "error in cycles left out, without it"},
    Field{"held_out_after_um", &Candidate::held_out_after_um, "error in cycles left out, with it"},
    Field{"p_same_gain", &Candidate::p_same_gain, "of gains as different from cycle to cycle, by chance"},
    Field{"in_best_set", &Candidate::in_best_set, "whether it is of the likeliest set"},
    Field{"minor", &Candidate::minor, "whether it is too small to matter"},
    Field{"doubts", &doubts_of, "why it is not named"},
    Field{"inseparable_from", &Candidate::inseparable_from, "effects that these data do not tell from it"},
    Field{"parameters", &parameters_of},
    Field{"label", in(&Candidate::bound, &label), "of the effect, with its columns"});

template <>
inline constexpr auto kResult<ColumnNotSearched> =
    ResultType("ColumnNotSearched", "A column that changes and that no effect of the search could read.",
               Field{"column", &ColumnNotSearched::column}, Field{"why", &why_not_searched});

// An effect that these data cannot show.
struct Untestable {
  std::string effect;
  Paragraph why;
};
std::vector<Untestable> untestable_of(const Diagnosis& found);

template <>
inline constexpr auto kResult<Untestable> = ResultType("Untestable", "An effect that these data cannot show.",
                                                       Field{"effect", &Untestable::effect},
                                                       Field{"why", &Untestable::why});

template <>
inline constexpr auto kResult<StandIn> = ResultType("StandIn", "An effect added earlier that others explain better.",
                                                    Field{"effect", &StandIn::effect},
                                                    Field{"by", &StandIn::by, "the others"},
                                                    Field{"command", &StandIn::command, "that replaces it"});

// The test that would decide.
struct DecidingTest {
  Paragraph text;
  std::optional<std::string> command;
};
std::optional<DecidingTest> deciding_test(const DiagnosisReport& report);

template <>
inline constexpr auto kResult<DecidingTest> = ResultType("DecidingTest", "The test that would decide.",
                                                         Field{"text", &DecidingTest::text, "what to do"},
                                                         Field{"command", may_lack(&DecidingTest::command),
                                                               "of a series: that plans it"});

template <>
inline constexpr auto kResult<Predictability> =
    ResultType("Predictability", "Whether what cannot be named can be predicted.",
               Field{"expected_um", in(&Predictability::forecasts, &Forecasts::rmse_um),
                     "RMSE of forecasts of a regression on all effects"},
               Field{"today_um", &Predictability::model_um, "RMSE of the model on the same rows"},
               Field{"constant_um", in(&Predictability::forecasts, &Forecasts::held_um),
                     "RMSE of the last value held, or of the mean; of several runs, of 0"},
               Field{"better", &Predictability::is_better, "than the model, and than the last value held"});

template <>
inline constexpr auto kResult<PredictedByColumns> = ResultType(
    "PredictedByColumns", "What the columns of the likeliest set predict better than a regression on all effects.",
    Field{"columns", &PredictedByColumns::columns, "an effect without columns by its name"},
    Field{"left_out_um", &PredictedByColumns::left_out_um, "RMSE in left-out cycles, with the set"},
    Field{"model_left_out_um", &PredictedByColumns::model_left_out_um,
          "RMSE there, of the model; null: more than the range of the readings"});

template <>
inline constexpr auto kResult<ParameterStart> = ResultType("ParameterStart", "A parameter that is freed.",
                                                           Field{"effect", &ParameterStart::effect},
                                                           Field{"parameter", &ParameterStart::parameter},
                                                           Field{"start", &ParameterStart::start, "of its fit"});

template <>
inline constexpr auto kResult<NextAction> =
    ResultType("NextAction", "What to do next.", Field{"action", &NextAction::action, "add, try, free, plan"},
               Field{"effects", &NextAction::effects, "to add, or to try, as `add` takes them"},
               Field{"labels", &NextAction::labels, "of these effects, as the candidates have them"},
               Field{"parameters", &NextAction::parameters, "to free"},
               Field{"promised_rmse_um", &NextAction::promised_rmse_um, "that the model leaves then; null: not known"});

constexpr auto of_diagnosis(auto get) { return in(&DiagnosisReport::diagnosis, get); }

// What a diagnosis adds to the comparison of the model with data.
inline constexpr FieldList kDiagnosisFields{
    Field{"verdict", of_diagnosis(&Diagnosis::verdict),
          "named, probable, driver, equivalent, unexplained, untestable, nothing"},
    Field{"sentence", of_diagnosis([](const Diagnosis& of) { return sentence_of(of); }), "what it says in plain words"},
    Field{"not_used", of_diagnosis(&not_used_sentences), "the first part of it: columns, rows and readings"},
    Field{"conclusion", of_diagnosis(&verdict_sentences), "the rest of it"},
    Field{"slow_drift", of_diagnosis(&slow_drift_beside),
          "of that, about a drift without a cause; empty: there is none"},
    Field{"command", &DiagnosisReport::command, "to type next; empty: none"},
    Field{"named", of_diagnosis(&Diagnosis::named), "that are missing"},
    Field{"probable", of_diagnosis(&Diagnosis::probable), "that are probably missing"},
    Field{"equivalent", of_diagnosis(&Diagnosis::equivalent),
          "sets, of each of which one may be missing, the likeliest first"},
    Field{"drivers", of_diagnosis(&Diagnosis::drivers), "from p = 0.5 on"},
    Field{"own", of_diagnosis(&Diagnosis::own), "values that the model holds and that may be others, from p = 0.05 on"},
    Field{"effects", of_diagnosis(&Diagnosis::effects), "from p = 0.01 on"},
    Field{"p_nothing", of_diagnosis(&Diagnosis::p_nothing), "probability that nothing is missing"},
    Field{"p_discrepancy", of_diagnosis(&Diagnosis::p_discrepancy), "probability of a slow curve without a cause"},
    Field{"discrepancy_um", of_diagnosis(&Diagnosis::discrepancy_um), "its standard deviation"},
    Field{"discrepancy_like", of_diagnosis(&Diagnosis::discrepancy_like),
          "effect of time alone that it follows; empty: none"},
    Field{"discrepancy_time_s", of_diagnosis(&Diagnosis::discrepancy_time_s), "of that effect; 0: none"},
    Field{"candidates", of_diagnosis(&Diagnosis::candidates), "the likeliest set, then others by probability"},
    Field{"next_action", &DiagnosisReport::next_action, "what the command does, or else is to do; null: nothing"},
    Field{"stand_ins", &DiagnosisReport::stand_ins, "effects added earlier that others explain better"},
    Field{"unsupported", &DiagnosisReport::unsupported, "effects of the model that no data supported"},
    Field{"columns_not_searched", of_diagnosis(&Diagnosis::columns_not_searched), "that change and may be the cause"},
    Field{"coarse_columns", of_diagnosis(&Diagnosis::coarse_columns), "whose steps may hide the cause"},
    Field{"saturated", of_diagnosis(&Diagnosis::saturated),
          "columns whose sensor stands at the end of its range, or is stuck"},
    Field{"sensor_jumps", of_diagnosis(&Diagnosis::sensor_jumps), "of the zero of a sensor, taken out"},
    Field{"set_aside", of_diagnosis(&Diagnosis::set_aside), "readings far from all others"},
    Field{"level_jumps", of_diagnosis(&Diagnosis::level_jumps),
          "jumps of the target, if three or more: none is an effect"},
    Field{"level_jump_um", of_diagnosis(&Diagnosis::level_jump_um), "their median"},
    Field{"explained_um", of_diagnosis(&Diagnosis::explained_um),
          "largest less smallest of what the likeliest set adds together, at most that of the readings"},
    Field{"hidden_um", of_diagnosis(&Diagnosis::hidden_um), "amplitude up to which an effect could hide in these data"},
    Field{"untestable", of_diagnosis(&untestable_of), "effects that these data cannot show"},
    Field{"not_searched", of_diagnosis(&not_searched_of), "effects with more choices of columns than were searched"},
    Field{"reasons", of_diagnosis([](const Diagnosis& of) { return reasons_of(of); }),
          "why it is not named, or not all of it"},
    Field{"gains_by_run", of_diagnosis(&Diagnosis::gains_by_run), "of several runs: gains that differ"},
    Field{"next_test", &deciding_test, "that would decide; null: nothing is open"},
    Field{"predicted", &DiagnosisReport::predicted,
          "null: all is named, the rest is noise, or no regression can be made"},
    Field{"predicted_by", &DiagnosisReport::predicted_by,
          "null: the likeliest set does not predict better than the regression"},
    Field{"train_command", &DiagnosisReport::train_command, "that predicts it; empty: not better"}};

template <>
inline constexpr auto kResult<DiagnosisReport> = ResultType("Diagnosed", "Which effect a model lacks.",
                                                            fields_of(&DiagnosisReport::residual_report),
                                                            kDiagnosisFields);

struct NotDiagnosed {
  std::string target, why;
};

template <>
inline constexpr auto kResult<NotDiagnosed> = ResultType("NotDiagnosed", "A target that could not be fitted.",
                                                         Field{"target", &NotDiagnosed::target, "column"},
                                                         Field{"not_diagnosed", &NotDiagnosed::why, "why"});

template <>
inline constexpr std::string_view kTargetsName<std::variant<DiagnosisReport, NotDiagnosed>> = "DiagnosedTargets";

template <>
inline constexpr auto kResult<ProbableSoFar> = ResultType("Hypothesis", "What may be missing.",
                                                          Field{"label", in(&ProbableSoFar::bound, &label),
                                                                "the effect with its columns"},
                                                          Field{"p", &ProbableSoFar::p, "probability"});

}  // namespace ballbar
