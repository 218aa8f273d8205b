// What `diagnose --json` prints of one target.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/diagnosis/posterior/search_options.hpp"
#include "ballbar/formats/results/diagnosis_results.hpp"
#include "diagnose/diagnosis_report.hpp"

namespace ballbar {

template <>
struct ResultType<StandIn> {
  static constexpr std::string_view name = "StandIn";
  static constexpr std::string_view meaning = "An effect added earlier that others explain better.";
  static constexpr std::tuple fields{Field{"effect", &StandIn::effect, ""}, Field{"by", &StandIn::by, "the others"},
                                     Field{"command", &StandIn::command, "that replaces it"}};
};

// The test that would decide.
struct DecidingTest {
  std::string text;
  MayLack<std::string> command;
};
std::optional<DecidingTest> deciding_test(const DiagnosisReport& report);

template <>
struct ResultType<DecidingTest> {
  static constexpr std::string_view name = "DecidingTest";
  static constexpr std::string_view meaning = "The test that would decide.";
  static constexpr std::tuple fields{Field{"text", &DecidingTest::text, "what to do"},
                                     Field{"command", &DecidingTest::command, "of a series: that plans it"}};
};

template <>
struct ResultType<Predictability> {
  using Of = const Predictability&;
  static constexpr std::string_view name = "Predictability";
  static constexpr std::string_view meaning = "Whether what cannot be named can be predicted.";
  static constexpr std::tuple fields{
      Field{"expected_um", [](Of of) { return of.forecasts.rmse_um; },
            "RMSE of forecasts of a regression on all effects"},
      Field{"today_um", &Predictability::model_um, "RMSE of the model on the same rows"},
      Field{"better", &Predictability::is_better, "than the model, and than the last value held"}};
};

template <>
struct ResultType<DiagnosisReport> {
  using Report = const DiagnosisReport&;
  static constexpr std::string_view name = "Diagnosed";
  static constexpr std::string_view meaning = "Which effect a model lacks.";
  static constexpr std::string_view kEffects = "from p = 0.01 on";
  static constexpr std::string_view kCandidates = "the likeliest set, then others by probability";
  static constexpr std::tuple of_diagnosis{
      Field{"verdict", &Diagnosis::verdict, "named, probable, driver, equivalent, unexplained, untestable, nothing"},
      Field{"sentence", &Diagnosis::sentence, "what it says in plain words"}};
  static constexpr std::tuple found{
      Field{"named", &Diagnosis::named, "that are missing"},
      Field{"probable", &Diagnosis::probable, "that are probably missing"},
      Field{"equivalent", &Diagnosis::equivalent, "sets, of each of which one may be missing, the likeliest first"},
      Field{"drivers", &Diagnosis::drivers, "from p = 0.5 on"},
      Field{"own", &Diagnosis::own, "values that the model holds and that may be others, from p = 0.05 on"}};
  static constexpr std::tuple probabilities{
      Field{"p_nothing", &Diagnosis::p_nothing, "probability that nothing is missing"},
      Field{"p_discrepancy", &Diagnosis::p_discrepancy, "probability of a slow curve without a cause"},
      Field{"discrepancy_um", &Diagnosis::discrepancy_um, "its standard deviation"}};
  static constexpr std::tuple hidden{
      Field{"explained_um", &Diagnosis::explained_um,
            "largest less smallest of what the likeliest set adds together, at most that of the readings"},
      Field{"hidden_um", &Diagnosis::hidden_um, "amplitude up to which an effect could hide in these data"},
      Field{"untestable", [](const Diagnosis& of) { return untestable_of(of); }, "effects that these data cannot show"},
      Field{"not_searched", [](const Diagnosis& of) { return not_searched_of(of); },
            "effects with more choices of columns than were searched"},
      Field{"reasons", &Diagnosis::reasons, "why it is not named, or not all of it"},
      Field{"gains_by_run", &Diagnosis::gains_by_run, "of several runs: gains that differ"}};
  // Of the report, about its effects and its candidates, which a page has more of.
  static constexpr std::tuple verdict_fields =
      std::tuple_cat(fields_through(&DiagnosisReport::diagnosis, of_diagnosis),
                     std::tuple{Field{"command", &DiagnosisReport::command, "to type next; empty: none"}},
                     fields_through(&DiagnosisReport::diagnosis, found));
  static constexpr std::tuple open = std::tuple_cat(
      std::tuple{Field{"stand_ins", &DiagnosisReport::stand_ins, "effects added earlier that others explain better"},
                 Field{"unsupported", &DiagnosisReport::unsupported, "effects of the model that no data supported"}},
      fields_through(&DiagnosisReport::diagnosis, hidden),
      std::tuple{Field{"next_test", &deciding_test, "that would decide; null: nothing is open"},
                 Field{"predicted", &DiagnosisReport::predicted, "null: all is named, or no regression can be made"},
                 Field{"train_command", &DiagnosisReport::train_command, "that predicts it; empty: not better"}});
  static constexpr std::tuple of_effects{Field{"effects", &Diagnosis::effects, kEffects}};
  static constexpr std::tuple of_candidates{Field{"candidates", &Diagnosis::candidates, kCandidates}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&DiagnosisReport::residual_report, ResultType<ResidualReport>::fields),
                     verdict_fields, fields_through(&DiagnosisReport::diagnosis, of_effects),
                     fields_through(&DiagnosisReport::diagnosis, probabilities),
                     fields_through(&DiagnosisReport::diagnosis, of_candidates), open);
};

struct NotDiagnosed {
  std::string target, why;
};

template <>
struct ResultType<NotDiagnosed> {
  static constexpr std::string_view name = "NotDiagnosed";
  static constexpr std::string_view meaning = "A target that could not be fitted.";
  static constexpr std::tuple fields{Field{"target", &NotDiagnosed::target, "column"},
                                     Field{"not_diagnosed", &NotDiagnosed::why, "why"}};
};

struct DiagnosedTargets {
  std::vector<std::variant<DiagnosisReport, NotDiagnosed>> targets;
};

template <>
struct ResultType<DiagnosedTargets> {
  static constexpr std::string_view name = "DiagnosedTargets";
  static constexpr std::string_view meaning = "Which effect a model of several targets lacks.";
  static constexpr std::tuple fields{
      Field{"targets", &DiagnosedTargets::targets, "of several targets, each as of one"}};
};

template <>
struct ResultType<ProbableSoFar> {
  static constexpr std::string_view name = "Hypothesis";
  static constexpr std::string_view meaning = "What may be missing.";
  static constexpr std::tuple fields{
      Field{"label", [](const ProbableSoFar& of) { return label_of(of.bound); }, "the effect with its columns"},
      Field{"p", &ProbableSoFar::p, "probability"}};
};

struct PosteriorSoFar {
  std::vector<ProbableSoFar> posterior;
};

template <>
struct ResultType<PosteriorSoFar> {
  static constexpr std::string_view name = "SoFar";
  static constexpr std::string_view meaning = "What a diagnosis says while it goes on.";
  static constexpr std::tuple fields{Field{"posterior", &PosteriorSoFar::posterior, "the most probable first"}};
};

}  // namespace ballbar
