// What `effects --json` prints of each effect.
#pragma once

#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

inline std::string_view name_of(ParameterKind kind) { return kind == ParameterKind::gain ? "gain" : "shape"; }

template <>
inline constexpr auto kResult<Input> =
    ResultType{"EffectInput", "What an effect reads.",
               std::tuple{Field{"role", &Input::role, ""}, Field{"units", &Input::units, "accepted"},
                          Field{"meaning", &Input::meaning, ""}}};

template <auto kBound>
MayLack<double> usual_of(const Parameter& of) {
  return {of.usual.empty() ? std::nullopt : std::optional(of.*kBound)};
}
inline MayLack<std::string> usual_source(const Parameter& of) {
  return {of.usual.empty() ? std::nullopt : std::optional(of.usual)};
}

template <>
inline constexpr auto kResult<Parameter> = ResultType{
    "EffectParameter", "A parameter of an effect.",
    std::tuple{Field{"name", &Parameter::name, "with its unit"}, Field{"unit", &Parameter::unit, "1: none"},
               Field{"kind", &Parameter::kind, "gain, shape"}, Field{"start", &Parameter::start, ""},
               Field{"lower", &Parameter::lower, "bound; null: none"},
               Field{"upper", &Parameter::upper, "bound; null: none"},
               Field{"held", &Parameter::held, "whether a model that does not name it keeps it at its start"},
               Field{"meaning", &Parameter::meaning, ""},
               Field{"usual_low", &usual_of<&Parameter::usual_low>, "of its size on machines, where it is known"},
               Field{"usual_high", &usual_of<&Parameter::usual_high>, ""},
               Field{"usual", &usual_source, "where that range comes from"}}};

inline constexpr auto kEffectPage =
    std::tuple{Field{"summary", &Explanation::summary, "in a line"},
               Field{"cause", &Explanation::cause, ""},
               Field{"formula", &Explanation::formula, "in the letters of the parameters"},
               Field{"signature", &Explanation::signature, "how it looks in a residual"},
               Field{"on_parts", &Explanation::on_parts, "what it does to circles and holes; empty: no error of axes"},
               Field{"confused_with", &Explanation::confused_with, "other effects"}};
inline constexpr auto kEffectUse =
    std::tuple{Field{"separated_by", &Explanation::separated_by, "the test that tells them apart"},
               Field{"remedy", &Explanation::remedy, "in the workshop"}, Field{"validity", &Explanation::validity, ""},
               Field{"source", &Explanation::source, ""}};

template <>
inline constexpr auto kResult<Effect> = ResultType{
    "Effect", "An effect of the catalogue.",
    std::tuple_cat(
        std::tuple{Field{"name", &Effect::name, ""}, Field{"level", &Effect::level, "series, recording"}},
        fields_through(&Effect::explanation, kEffectPage),
        std::tuple{Field{"becomes", [](const Effect& of) { return of.rules.becomes; },
                         "another one at the edge of its shapes; empty: none"}},
        fields_through(&Effect::explanation, kEffectUse),
        std::tuple{Field{"time_only", &Effect::time_only, "whether it needs nothing but time"},
                   Field{"inputs", &Effect::inputs, "that it reads"}, Field{"parameters", &Effect::parameters, ""}})};

// A word of statistics, as results use it.
struct ExplainedTerm {
  std::string_view name, meaning;
};

template <>
inline constexpr auto kResult<ExplainedTerm> =
    ResultType{"ExplainedTerm", "A word of statistics.",
               std::tuple{Field{"name", &ExplainedTerm::name, "the word"},
                          Field{"meaning", &ExplainedTerm::meaning, "of the word, in a sentence"}}};

struct ExplainedTerms {
  std::vector<ExplainedTerm> terms;
};

template <>
inline constexpr auto kResult<ExplainedTerms> =
    ResultType{"ExplainedTerms", "The words of statistics.",
               std::tuple{Field{"terms", &ExplainedTerms::terms, "of tables and texts"}}};

// A list, which Python has as this.
struct EffectPages {
  std::vector<Effect> effects;
};

template <>
inline constexpr auto kResult<EffectPages> =
    ResultType{"Effects", "The catalogue, or an effect of it.",
               std::tuple{Field{"effects", &EffectPages::effects, "of the whole catalogue"}}};

}  // namespace ballbar
