// What `effects --json` prints of each effect.
#pragma once

#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

inline std::string_view name_of(Level level) { return level == Level::series ? "series" : "recording"; }
inline std::string_view name_of(ParameterKind kind) { return kind == ParameterKind::gain ? "gain" : "shape"; }

template <>
struct ResultType<Input> {
  static constexpr std::string_view name = "EffectInput";
  static constexpr std::string_view meaning = "What an effect reads.";
  static constexpr std::tuple fields{Field{"role", &Input::role, ""}, Field{"units", &Input::units, "accepted"},
                                     Field{"meaning", &Input::meaning, ""}};
};

template <>
struct ResultType<Parameter> {
  static constexpr std::string_view name = "EffectParameter";
  static constexpr std::string_view meaning = "A parameter of an effect.";
  static constexpr std::tuple fields{
      Field{"name", &Parameter::name, "with its unit"},
      Field{"unit", &Parameter::unit, "1: none"},
      Field{"kind", &Parameter::kind, "gain, shape"},
      Field{"start", &Parameter::start, ""},
      Field{"lower", &Parameter::lower, "bound; null: none"},
      Field{"upper", &Parameter::upper, "bound; null: none"},
      Field{"held", &Parameter::held, "whether a model that does not name it keeps it at its start"},
      Field{"meaning", &Parameter::meaning, ""}};
};

template <>
struct ResultType<Effect> {
  static constexpr std::string_view name = "Effect";
  static constexpr std::string_view meaning = "An effect of the catalogue.";
  static constexpr std::tuple page{Field{"summary", &Explanation::summary, "in a line"},
                                   Field{"cause", &Explanation::cause, ""},
                                   Field{"formula", &Explanation::formula, "in the letters of the parameters"},
                                   Field{"signature", &Explanation::signature, "how it looks in a residual"},
                                   Field{"confused_with", &Explanation::confused_with, "other effects"}};
  static constexpr std::tuple use{Field{"separated_by", &Explanation::separated_by, "the test that tells them apart"},
                                  Field{"remedy", &Explanation::remedy, "in the workshop"},
                                  Field{"validity", &Explanation::validity, ""},
                                  Field{"source", &Explanation::source, ""}};
  static constexpr std::tuple fields = std::tuple_cat(
      std::tuple{Field{"name", &Effect::name, ""}, Field{"level", &Effect::level, "series, recording"}},
      fields_through(&Effect::explanation, page),
      std::tuple{Field{"becomes", [](const Effect& of) { return of.rules.becomes; },
                       "another one at the edge of its shapes; empty: none"}},
      fields_through(&Effect::explanation, use),
      std::tuple{Field{"time_only", &Effect::time_only, "whether it needs nothing but time"},
                 Field{"inputs", &Effect::inputs, "that it reads"}, Field{"parameters", &Effect::parameters, ""}});
};

// A word of statistics, as results use it.
struct ExplainedTerm {
  std::string_view name, meaning;
};

template <>
struct ResultType<ExplainedTerm> {
  static constexpr std::string_view name = "ExplainedTerm";
  static constexpr std::string_view meaning = "A word of statistics.";
  static constexpr std::tuple fields{Field{"name", &ExplainedTerm::name, "the word"},
                                     Field{"meaning", &ExplainedTerm::meaning, "of the word, in a sentence"}};
};

struct ExplainedTerms {
  std::vector<ExplainedTerm> terms;
};

template <>
struct ResultType<ExplainedTerms> {
  static constexpr std::string_view name = "ExplainedTerms";
  static constexpr std::string_view meaning = "The words of statistics.";
  static constexpr std::tuple fields{Field{"terms", &ExplainedTerms::terms, "of tables and texts"}};
};

// A list, which Python has as this.
struct EffectPages {
  std::vector<Effect> effects;
};

template <>
struct ResultType<EffectPages> {
  static constexpr std::string_view name = "Effects";
  static constexpr std::string_view meaning = "The catalogue, or an effect of it.";
  static constexpr std::tuple fields{Field{"effects", &EffectPages::effects, "of the whole catalogue"}};
};

}  // namespace ballbar
