#include "ballbar/model/model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"

namespace ballbar {
namespace {

std::string_view level_name(Level level) { return level == Level::series ? "a drift series" : "a recording"; }

Level other_than(Level level) { return level == Level::series ? Level::recording : Level::series; }

// For a sentence: whole but for what nobody would read to the end.
std::string readable(std::string_view name) {
  constexpr std::size_t kLongest = 200;
  if (name.size() <= kLongest) return std::string(name);
  const std::string quoted = in_quotes(name);
  return quoted.substr(1, quoted.size() - 2);
}

// "a, b, c"; a log of a machine can have hundreds.
std::string listed(const std::vector<std::string_view>& names) {
  constexpr std::size_t kMostListed = 30;
  if (names.size() > kMostListed) return fmt::format("{} names", names.size());
  std::vector<std::string> all;
  all.reserve(names.size());
  for (const std::string_view name : names) all.push_back(readable(name));
  return fmt::format("{}", fmt::join(all, ", "));
}

// Whether the name of a column ends in one of the units; "1" is a column without a unit, no units are any.
bool takes(const std::vector<std::string>& units, std::string_view column) {
  return units.empty() || std::any_of(units.begin(), units.end(), [&](const std::string& unit) {
           return unit == "1" ? unit_of(column).empty() : column.ends_with("_" + unit);
         });
}

std::string found_unit(std::string_view column) {
  const std::string_view unit = unit_of(column);
  return unit.empty() ? "has no such unit" : fmt::format("is in {}", unit);
}

[[noreturn]] void fail(std::string_view where, std::string_view sentence) {
  throw Error(fmt::format("{}: {}", readable(where), sentence));
}

void expect_column(const Series& data, std::string_view column, std::string_view where, std::string_view purpose) {
  if (find_column(data, column) != nullptr) return;
  std::vector<std::string_view> known;
  for (const Column& candidate : data.columns) known.push_back(candidate.name);
  if (known.empty()) {
    fail(where,
         fmt::format("expected the column {} in the data for {}, found no columns.", in_quotes(column), purpose));
  }
  fail(where, fmt::format("expected a column of the data for {}, one of {}, found {}; the nearest is {}.", purpose,
                          listed(known), in_quotes(column), readable(nearest_name(column, known))));
}

void expect_targets(const Model& model, const Series& data) {
  if (model.targets.empty()) fail("target", "expected at least one column to explain, found none.");
  for (auto target = model.targets.begin(); target != model.targets.end(); ++target) {
    if (std::find(model.targets.begin(), target, *target) != target) {
      fail("target", fmt::format("expected each column once, found {} again.", in_quotes(*target)));
    }
    expect_column(data, *target, "target", "the target");
  }
}

void expect_inputs(const Model& model, const Term& term, const Series& data) {
  const std::string where = label_of(term);
  const std::vector<Input>& inputs = term.effect->inputs;
  if (term.columns.size() != inputs.size()) {
    std::vector<std::string_view> roles;
    roles.reserve(inputs.size());
    for (const Input& input : inputs) roles.push_back(input.role);
    fail(where, fmt::format("expected {} column{}{}{}, found {}.",
                            inputs.empty() ? "no" : std::to_string(inputs.size()), inputs.size() == 1 ? "" : "s",
                            inputs.empty() ? "" : ", for ", fmt::join(roles, " and "), term.columns.size()));
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string& column = term.columns[i];
    expect_column(data, column, where, inputs[i].role);
    if (!takes(inputs[i].units, column)) {
      fail(where, fmt::format("expected a column in {} for {}, found {}, which {}.", fmt::join(inputs[i].units, " or "),
                              inputs[i].role, in_quotes(column), found_unit(column)));
    }
    const auto other = std::find(term.columns.begin(), term.columns.begin() + static_cast<std::ptrdiff_t>(i), column);
    if (other != term.columns.begin() + static_cast<std::ptrdiff_t>(i)) {
      fail(where, fmt::format("expected different columns for {} and {}, found {} for both.",
                              inputs[static_cast<std::size_t>(other - term.columns.begin())].role, inputs[i].role,
                              in_quotes(column)));
    }
    if (std::find(model.targets.begin(), model.targets.end(), column) != model.targets.end()) {
      fail(where,
           fmt::format("expected a column other than the target for {}, found {}, which the model is to explain.",
                       inputs[i].role, in_quotes(column)));
    }
  }
}

void expect_settings(const Term& term) {
  const std::string where = label_of(term);
  assert(term.settings.size() == term.effect->parameters.size());
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const Setting& setting = term.settings[k];
    const std::string& name = term.effect->parameters[k].name;
    if (!std::isfinite(setting.start)) {
      fail(where, fmt::format("expected a finite number for {}, found {}.", name, setting.start));
    }
    if (!(setting.lower < setting.upper)) {
      fail(where, fmt::format("expected lower below upper for {}, found lower {} and upper {}.", name, setting.lower,
                              setting.upper));
    }
    if (setting.start < setting.lower || setting.start > setting.upper) {
      fail(where, fmt::format("expected {} from {} to {} for {}, found {}.", setting.held ? "a value" : "a start",
                              setting.lower, setting.upper, name, setting.start));
    }
  }
}

bool is_held(const Term& term) {
  return std::all_of(term.settings.begin(), term.settings.end(), [](const Setting& setting) { return setting.held; });
}

bool same_term(const Term& left, const Term& right) {
  if (left.effect->name != right.effect->name || left.columns != right.columns || label_of(left) != label_of(right)) {
    return false;
  }
  if (is_held(left) != is_held(right)) return false;  // what is held is taken off, and cannot be mistaken for the other
  // Of one recording each: the same effect on another.
  for (std::size_t k = 0; k < left.settings.size(); ++k) {
    const bool held = left.settings[k].held && right.settings[k].held;
    if (held && left.settings[k].start != right.settings[k].start) return false;
  }
  return true;
}

// "onset_s = 3600" or "onset_s from 0 to 3600": what a model says of the shapes of a term.
std::vector<std::string> shapes_stated(const Term& term) {
  std::vector<std::string> stated;
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const Parameter& parameter = term.effect->parameters[k];
    const Setting& setting = term.settings[k];
    if (parameter.kind == ParameterKind::gain || parameter.shape_of == ShapeOf::recording) continue;
    if (setting.stated) {
      stated.push_back(fmt::format("{} = {}", parameter.name, setting.start));
    } else if (setting.lower != parameter.lower || setting.upper != parameter.upper) {
      stated.push_back(fmt::format("{} from {} to {}", parameter.name, setting.lower, setting.upper));
    }
  }
  return stated;
}

// What is there to be done about the same term twice.
std::string once(const Term& term) {
  std::vector<std::string_view> shapes;
  for (const Parameter& parameter : term.effect->parameters) {
    const bool tells = parameter.kind == ParameterKind::shape && parameter.shape_of != ShapeOf::recording;
    if (tells) shapes.push_back(parameter.name);
  }
  if (term.effect->name == "expression") return "each formula once";
  if (!term.effect->inputs.empty() && term.effect->level == Level::series)
    return "each effect on the same columns once";
  if (shapes.empty()) return "each effect once";
  return fmt::format("each effect once, or with another start stated for {}", fmt::join(shapes, " or "));
}

}  // namespace

Term term_of(std::string_view effect_name, std::vector<std::string> columns, Level level, const Catalogue& catalogue) {
  if (effect_name == "expression") {
    throw Error("expression: expected an effect of the catalogue, found one that needs a formula.");
  }
  const Effect* effect = find_effect(effect_name, level, catalogue);
  if (effect == nullptr) {
    std::vector<std::string_view> known;
    for (const auto& candidate : catalogue) {
      if (candidate->level == level) known.push_back(candidate->name);
    }
    const std::string expected = fmt::format("expected an effect on {}, one of {}, found {}", level_name(level),
                                             listed(known), in_quotes(effect_name));
    if (find_effect(effect_name, other_than(level), catalogue) != nullptr) {
      throw Error(fmt::format("{}, which is one on {}.", expected, level_name(other_than(level))));
    }
    if (known.empty()) {
      throw Error(fmt::format("expected an effect on {}, of which there are none, found {}.", level_name(level),
                              in_quotes(effect_name)));
    }
    throw Error(fmt::format("{}; the nearest is {}.", expected, nearest_name(effect_name, known)));
  }
  Term term = term_of(*effect, std::move(columns));
  term.effect = *std::find_if(catalogue.begin(), catalogue.end(), [&](const auto& one) { return one.get() == effect; });
  return term;
}

Term term_of(const Effect& effect, std::vector<std::string> columns) {
  if (effect.level == Level::recording && columns.empty()) {
    for (const Input& input : effect.inputs) columns.emplace_back(trace_column(input.role));
  }
  Term term{std::shared_ptr<const Effect>(std::shared_ptr<const Effect>{}, &effect), std::move(columns), {}};
  for (const Parameter& parameter : effect.parameters) {
    term.settings.push_back({parameter.held, parameter.start, parameter.lower, parameter.upper, false});
  }
  return term;
}

std::string label_of(const Term& term) {
  const Effect& effect = *term.effect;
  if (effect.name == "expression") return fmt::format("expression({})", effect.explanation.formula);
  for (std::size_t k = 0; k < effect.parameters.size() && k < term.settings.size(); ++k) {
    if (effect.parameters[k].shape_of != ShapeOf::recording || term.settings[k].start < 0.0) continue;
    return fmt::format("{} {:g}", effect.name, term.settings[k].start + 1.0);
  }
  if (term.columns.empty() || effect.level == Level::recording) {
    const std::vector<std::string> shapes = shapes_stated(term);
    return shapes.empty() ? effect.name : fmt::format("{}({})", effect.name, fmt::join(shapes, ", "));
  }
  return fmt::format("{}({})", effect.name, fmt::join(term.columns, ", "));
}

bool has_free(const Model& model) {
  if (model.level == Level::series && !model.constant_um) return true;
  return std::any_of(model.terms.begin(), model.terms.end(), [](const Term& term) {
    return std::any_of(term.settings.begin(), term.settings.end(),
                       [](const Setting& setting) { return !setting.held; });
  });
}

void expect_suits(const Model& model, const Series& data) {
  expect_targets(model, data);
  for (std::size_t i = 0; i < model.terms.size(); ++i) {
    const Term& term = model.terms[i];
    if (term.effect->level != model.level) {
      fail(label_of(term), fmt::format("expected effects on {}, found one on {}.", level_name(model.level),
                                       level_name(term.effect->level)));
    }
    expect_settings(term);
    if (term.effect->name == "expression") expect_expression_suits(term, data);
    expect_inputs(model, term, data);
    for (std::size_t j = 0; j < i; ++j) {
      if (!same_term(model.terms[j], term)) continue;
      fail(label_of(term), fmt::format("expected {}, found it as effects {} and {}.", once(term), j + 1, i + 1));
    }
  }
  if (model.constant_um && !std::isfinite(*model.constant_um)) {
    fail("constant_um", fmt::format("expected a finite number, found {}.", *model.constant_um));
  }
  if (!has_free(model)) {
    throw Error("expected at least one free parameter, found none: every parameter is held.");
  }
}

void expect_explainable(const std::vector<std::string>& targets, const Series& data) {
  Model bare;
  bare.targets = targets;
  expect_suits(bare, data);
}

}  // namespace ballbar
