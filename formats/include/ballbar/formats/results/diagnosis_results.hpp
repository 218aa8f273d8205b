// What a model may lack, as results.
#pragma once

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/formats/results/fit_results.hpp"

namespace ballbar {

// By role: {"temperature": "T_room_degC"}.
TableOf<std::string> columns_of(const BoundEffect& bound);

template <>
inline constexpr auto kResult<BoundEffect> = ResultType("Bound", "An effect on columns of the data.",
                                                        Field{"effect", in(&BoundEffect::effect, &Effect::name),
                                                              "as `ballbar effects` lists it"},
                                                        Field{"columns", &columns_of, "by role"});

inline std::string label(const BoundEffect& bound) { return label_of(bound); }

// A parameter of a candidate, with its interval of 95 %.
struct CandidateParameter {
  FittedParameter parameter;
  Interval interval;
};
std::vector<CandidateParameter> parameters_of(const Candidate& candidate);

template <>
inline constexpr auto kResult<CandidateParameter> =
    ResultType("CandidateParameter", "A parameter of a candidate.",
               Field{"name", in(&CandidateParameter::parameter, &FittedParameter::name), "with its unit"},
               Field{"value", in(&CandidateParameter::parameter, &FittedParameter::value)},
               Field{"sigma", in(&CandidateParameter::parameter, &FittedParameter::sigma), "null: not determined"},
               Field{"low", in(&CandidateParameter::interval, &Interval::low), "of the interval of 95 %"},
               Field{"high", in(&CandidateParameter::interval, &Interval::high)},
               Field{"unit", in(&CandidateParameter::parameter, &FittedParameter::unit)});

template <>
inline constexpr auto kResult<Driver> = ResultType(
    "Driver", "A column that drives what is missing, whatever its form.", Field{"column", &Driver::column},
    Field{"p", &Driver::p, "probability"},
    Field{"is_clear", &Driver::is_clear, "false: beside a larger slow drift, or other columns of a few readings"});

template <>
inline constexpr auto kResult<CoarseColumn> = ResultType(
    "CoarseColumn", "A column whose resolution hides whether it is the cause.", Field{"column", &CoarseColumn::column},
    Field{"resolution", &CoarseColumn::resolution, "in the unit of the column"});

template <>
inline constexpr auto kResult<SensorJump> = ResultType("SensorJump", "A jump of the zero of a sensor.",
                                                       Field{"column", &SensorJump::column},
                                                       Field{"run", &SensorJump::run, "empty: there is one"},
                                                       Field{"time_s", &SensorJump::time_s},
                                                       Field{"size", &SensorJump::size, "in the unit of the column"});

template <>
inline constexpr auto kResult<Saturated> = ResultType(
    "Saturated", "A column whose sensor stands at the end of its range, or is stuck.",
    Field{"column", &Saturated::column}, Field{"share", &Saturated::share, "of the rows, which are set aside"},
    Field{"is_stuck", &Saturated::is_stuck, "whether it is stuck, else at the end of its range"});

template <>
inline constexpr auto kResult<OwnValue> = ResultType(
    "OwnValue", "A value that the model holds, and that may be another one.",
    Field{"effect", &OwnValue::effect, "of the model, with its columns"}, Field{"parameter", &OwnValue::parameter},
    Field{"unit", &OwnValue::unit}, Field{"held", &OwnValue::held, "as the model has it"},
    Field{"fitted", &OwnValue::fitted, "as the data have it"},
    Field{"low", in(&OwnValue::interval, &Interval::low), "of the interval of 95 %"},
    Field{"high", in(&OwnValue::interval, &Interval::high)},
    Field{"p", &OwnValue::p, "probability that it is another one"});

template <>
inline constexpr auto kResult<EffectProbability> =
    ResultType("EffectProbability", "An effect, and the probability that it is missing.",
               fields_of(&EffectProbability::bound), Field{"p", &EffectProbability::p, "probability"},
               Field{"label", in(&EffectProbability::bound, &label), "of the effect, with its columns"});

// An effect with more choices of columns than were searched.
struct NotSearched {
  std::string effect;
  std::size_t choices_of_columns = 0, searched = 0;
};
std::vector<NotSearched> not_searched_of(const Diagnosis& found);

template <>
inline constexpr auto kResult<NotSearched> = ResultType("NotSearched",
                                                        "An effect with more choices of columns than were searched.",
                                                        Field{"effect", &NotSearched::effect},
                                                        Field{"choices_of_columns", &NotSearched::choices_of_columns},
                                                        Field{"searched", &NotSearched::searched, "of these"});

// A gain in one run.
struct GainOfRun {
  double gain = 0.0, sigma = 0.0;
};
std::vector<GainOfRun> runs_of(const GainByRun& gain);

template <>
inline constexpr auto kResult<GainOfRun> = ResultType("GainOfRun", "A gain in one run.",
                                                      Field{"gain", &GainOfRun::gain},
                                                      Field{"sigma", &GainOfRun::sigma});

template <>
inline constexpr auto kResult<GainByRun> =
    ResultType("GainByRun", "A gain that is another one from run to run.",
               Field{"effect", &GainByRun::effect, "with its columns"}, Field{"parameter", &GainByRun::parameter},
               Field{"unit", &GainByRun::unit}, Field{"p", &GainByRun::p, "of gains as different, were it one gain"},
               Field{"runs", [](const GainByRun& gain) { return runs_of(gain); }, "the gain in each"});

}  // namespace ballbar
