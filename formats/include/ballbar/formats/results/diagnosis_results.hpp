// What a model may lack, as results.
#pragma once

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/formats/results/fit_results.hpp"

namespace ballbar {

// By role: {"temperature": "T_room_degC"}.
TableOf<std::string> columns_of(const BoundEffect& bound);

template <>
inline constexpr auto kResult<BoundEffect> =
    ResultType{"Bound", "An effect on columns of the data.",
               std::tuple{Field{"effect", [](const BoundEffect& bound) { return bound.effect->name; },
                                "as `ballbar effects` lists it"},
                          Field{"columns", &columns_of, "by role"}}};

// A parameter of a candidate, with its interval of 95 %.
struct CandidateParameter {
  FittedParameter parameter;
  Interval interval;
};
std::vector<CandidateParameter> parameters_of(const Candidate& candidate);

template <>
inline constexpr auto kResult<CandidateParameter> = ResultType{
    "CandidateParameter", "A parameter of a candidate.",
    std::tuple{Field{"name", [](const CandidateParameter& of) { return of.parameter.name; }, "with its unit"},
               Field{"value", [](const CandidateParameter& of) { return of.parameter.value; }, ""},
               Field{"sigma", [](const CandidateParameter& of) { return of.parameter.sigma; }, "null: not determined"},
               Field{"low", [](const CandidateParameter& of) { return of.interval.low; }, "of the interval of 95 %"},
               Field{"high", [](const CandidateParameter& of) { return of.interval.high; }, ""},
               Field{"unit", [](const CandidateParameter& of) { return of.parameter.unit; }, ""}}};

template <>
inline constexpr auto kResult<Driver> =
    ResultType{"Driver", "A column that drives what is missing, whatever its form.",
               std::tuple{Field{"column", &Driver::column, ""}, Field{"p", &Driver::p, "probability"},
                          Field{"is_clear", &Driver::is_clear,
                                "false: beside a larger slow drift, or other columns of a few readings"}}};

template <>
inline constexpr auto kResult<Saturated> =
    ResultType{"Saturated", "A column whose sensor stands at the end of its range.",
               std::tuple{Field{"column", &Saturated::column, ""},
                          Field{"share", &Saturated::share, "of the rows, which are set aside"}}};

template <>
inline constexpr auto kResult<OwnValue> =
    ResultType{"OwnValue", "A value that the model holds, and that may be another one.",
               std::tuple{Field{"effect", &OwnValue::effect, "of the model, with its columns"},
                          Field{"parameter", &OwnValue::parameter, ""}, Field{"unit", &OwnValue::unit, ""},
                          Field{"held", &OwnValue::held, "as the model has it"},
                          Field{"fitted", &OwnValue::fitted, "as the data have it"},
                          Field{"low", [](const OwnValue& own) { return own.interval.low; }, "of the interval of 95 %"},
                          Field{"high", [](const OwnValue& own) { return own.interval.high; }, ""},
                          Field{"p", &OwnValue::p, "probability that it is another one"}}};

template <>
inline constexpr auto kResult<EffectProbability> =
    ResultType{"EffectProbability", "An effect, and the probability that it is missing.",
               std::tuple_cat(fields_through(&EffectProbability::bound, kResult<BoundEffect>.fields),
                              std::tuple{Field{"p", &EffectProbability::p, "probability"}})};

// An effect with more choices of columns than were searched.
struct NotSearched {
  std::string effect;
  std::size_t choices_of_columns = 0, searched = 0;
};
std::vector<NotSearched> not_searched_of(const Diagnosis& found);

template <>
inline constexpr auto kResult<NotSearched> =
    ResultType{"NotSearched", "An effect with more choices of columns than were searched.",
               std::tuple{Field{"effect", &NotSearched::effect, ""},
                          Field{"choices_of_columns", &NotSearched::choices_of_columns, ""},
                          Field{"searched", &NotSearched::searched, "of these"}}};

// A gain in one run.
struct GainOfRun {
  double gain = 0.0, sigma = 0.0;
};
std::vector<GainOfRun> runs_of(const GainByRun& gain);

template <>
inline constexpr auto kResult<GainOfRun> =
    ResultType{"GainOfRun", "A gain in one run.",
               std::tuple{Field{"gain", &GainOfRun::gain, ""}, Field{"sigma", &GainOfRun::sigma, ""}}};

template <>
inline constexpr auto kResult<GainByRun> =
    ResultType{"GainByRun", "A gain that is another one from run to run.",
               std::tuple{Field{"effect", &GainByRun::effect, "with its columns"},
                          Field{"parameter", &GainByRun::parameter, ""}, Field{"unit", &GainByRun::unit, ""},
                          Field{"p", &GainByRun::p, "of gains as different, were it one gain"},
                          Field{"runs", [](const GainByRun& gain) { return runs_of(gain); }, "the gain in each"}}};

}  // namespace ballbar
