// What `effects --json` prints of each effect.
#pragma once

#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

inline std::string_view name_of(ParameterKind kind) { return kind == ParameterKind::gain ? "gain" : "shape"; }

template <>
inline constexpr auto kResult<Input> = ResultType("EffectInput", "What an effect reads.", Field{"role", &Input::role},
                                                  Field{"units", &Input::units, "accepted"},
                                                  Field{"meaning", &Input::meaning});

constexpr auto if_usual(auto get) {
  return where([](const Parameter& of) { return !of.usual.empty(); }, get);
}

template <>
inline constexpr auto kResult<Parameter> =
    ResultType("EffectParameter", "A parameter of an effect.", Field{"name", &Parameter::name, "with its unit"},
               Field{"unit", &Parameter::unit, "1: none"}, Field{"kind", &Parameter::kind, "gain, shape"},
               Field{"start", &Parameter::start}, Field{"lower", &Parameter::lower, "bound; null: none"},
               Field{"upper", &Parameter::upper, "bound; null: none"},
               Field{"held", &Parameter::held, "whether a model that does not name it keeps it at its start"},
               Field{"meaning", &Parameter::meaning},
               Field{"usual_low", if_usual(&Parameter::usual_low), "of its size on machines, where it is known"},
               Field{"usual_high", if_usual(&Parameter::usual_high)},
               Field{"usual", may_lack(&Parameter::usual), "where that range comes from"});

constexpr auto explained(auto get) { return in(&Effect::explanation, get); }

template <>
inline constexpr auto kResult<Effect> = ResultType(
    "Effect", "An effect of the catalogue.", Field{"name", &Effect::name},
    Field{"level", &Effect::level, "series, recording"},
    Field{"summary", explained(&Explanation::summary), "in a line"}, Field{"cause", explained(&Explanation::cause)},
    Field{"formula", explained(&Explanation::formula), "in the letters of the parameters"},
    Field{"signature", explained(&Explanation::signature), "how it looks in a residual"},
    Field{"on_parts", explained(&Explanation::on_parts), "what it does to circles and holes; empty: no error of axes"},
    Field{"confused_with", explained(&Explanation::confused_with), "other effects"},
    Field{"becomes", in(&Effect::rules, &EffectRules::becomes), "another one at the edge of its shapes; empty: none"},
    Field{"separated_by", explained(&Explanation::separated_by), "the test that tells them apart"},
    Field{"remedy", explained(&Explanation::remedy), "in the workshop"},
    Field{"validity", explained(&Explanation::validity)}, Field{"source", explained(&Explanation::source)},
    Field{"time_only", &Effect::time_only, "whether it needs nothing but time"},
    Field{"inputs", &Effect::inputs, "that it reads"}, Field{"parameters", &Effect::parameters});

// A word of statistics, as results use it.
struct ExplainedTerm {
  std::string_view name, meaning;
};

template <>
inline constexpr auto kResult<ExplainedTerm> = ResultType("ExplainedTerm", "A word of statistics.",
                                                          Field{"name", &ExplainedTerm::name, "the word"},
                                                          Field{"meaning", &ExplainedTerm::meaning,
                                                                "of the word, in a sentence"});

// The catalogue, which JSON has as a list, or the terms.
struct EffectPages {
  std::vector<Effect> effects;
  std::vector<ExplainedTerm> terms;
};

template <>
inline constexpr auto kResult<EffectPages> =
    ResultType("Effects", "The catalogue, an effect of it, or the statistical terms.",
               Field{"effects", may_lack(&EffectPages::effects), "of the whole catalogue"},
               Field{"terms", may_lack(&EffectPages::terms), "of tables and texts"});

}  // namespace ballbar
