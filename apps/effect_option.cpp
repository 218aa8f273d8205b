#include "effect_option.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "ballbar/trace.hpp"

namespace ballbar {
namespace {

const Effect& effect_called(std::string_view name, Level level) {
  if (const Effect* effect = find_effect(name, level)) return *effect;
  std::vector<std::string_view> known;
  for (const Effect* effect : effects()) {
    if (effect->level == level) known.emplace_back(effect->name);
  }
  throw Error(fmt::format("expected an effect of the catalogue, found {}; the nearest is {}.", in_quotes(name),
                          nearest_name(name, known)));
}

std::vector<std::string> choices_of(const Input& input, const Series& data, std::string_view target) {
  std::vector<std::string> choices;
  for (const Column& column : data.columns) {
    const std::string unit(unit_of(column.name));
    const bool suits = std::find(input.units.begin(), input.units.end(), unit) != input.units.end();
    if (suits && column.name != target) choices.push_back(column.name);
  }
  return choices;
}

std::string column_of(const EffectOption& option, const Input& input, const Series& data, std::string_view target) {
  const auto stated = std::find_if(option.columns.begin(), option.columns.end(),
                                   [&](const auto& one) { return one.first == input.role; });
  const Effect& effect = *option.effect;
  if (stated == option.columns.end()) {
    if (effect.level == Level::recording) return std::string(trace_column(input.role));
    const std::vector<std::string> choices = choices_of(input, data, target);
    if (choices.size() == 1) return choices.front();
    if (choices.empty()) {
      throw Error(fmt::format("expected a column in {} for {} of {}, found none.", fmt::join(input.units, " or "),
                              input.role, effect.name));
    }
    throw Error(fmt::format("expected a column for {} of {}, as in {}:{}={}; the columns are {}.", input.role,
                            effect.name, effect.name, input.role, choices.front(), fmt::join(choices, ", ")));
  }
  const std::string& column = stated->second;
  if (find_column(data, column) == nullptr) {
    std::vector<std::string_view> known;
    for (const Column& one : data.columns) known.emplace_back(one.name);
    throw Error(fmt::format("expected a column of the data for {} of {}, found {}; the nearest is {}.", input.role,
                            effect.name, in_quotes(column), nearest_name(column, known)));
  }
  const std::string unit(unit_of(column));
  if (effect.level == Level::series && std::find(input.units.begin(), input.units.end(), unit) == input.units.end()) {
    throw Error(fmt::format("expected a column in {} for {} of {}, found {}.", fmt::join(input.units, " or "),
                            input.role, effect.name, in_quotes(column)));
  }
  if (column == target) {
    throw Error(fmt::format("expected a column for {} of {} that is not the target, found {}.", input.role, effect.name,
                            in_quotes(column)));
  }
  return column;
}

}  // namespace

EffectOption effect_option(std::string_view text, Level level) {
  const std::size_t colon = text.find(':');
  EffectOption option{&effect_called(text.substr(0, colon), level), {}};
  if (colon == std::string_view::npos) return option;
  const Effect& effect = *option.effect;
  std::string_view rest = text.substr(colon + 1);
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    more = comma != std::string_view::npos;
    const std::string_view one = rest.substr(0, comma);
    rest.remove_prefix(more ? comma + 1 : rest.size());
    const std::size_t equals = one.find('=');
    if (equals == std::string_view::npos || equals + 1 == one.size()) {
      throw Error(fmt::format("expected ROLE=COLUMN after {}:, found {}.", effect.name, in_quotes(one)));
    }
    const std::string role(one.substr(0, equals));
    std::vector<std::string_view> roles;
    for (const Input& input : effect.inputs) roles.emplace_back(input.role);
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      throw Error(roles.empty() ? fmt::format("expected no column for {}, found {}.", effect.name, in_quotes(one))
                                : fmt::format("expected a role of {}, {}, found {}.", effect.name,
                                              fmt::join(roles, ", "), in_quotes(role)));
    }
    if (std::any_of(option.columns.begin(), option.columns.end(), [&](const auto& it) { return it.first == role; })) {
      throw Error(fmt::format("expected each role of {} once, found {} again.", effect.name, in_quotes(role)));
    }
    option.columns.emplace_back(role, std::string(one.substr(equals + 1)));
  }
  return option;
}

BoundEffect bound_to(const EffectOption& option, const Series& data, std::string_view target) {
  BoundEffect bound{option.effect, {}};
  for (const Input& input : option.effect->inputs) bound.columns.push_back(column_of(option, input, data, target));
  return bound;
}

}  // namespace ballbar
