#include "model/resolve_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ballbar/circle/trace.hpp"
#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"

namespace ballbar {
namespace {

std::vector<std::string> choices_of(const Input& input, const Series& data, std::string_view target) {
  std::vector<std::string> choices;
  for (const Column& column : data.columns) {
    const std::string unit(unit_of(column.name));
    const bool suits =
        input.units.empty() || std::find(input.units.begin(), input.units.end(), unit) != input.units.end();
    if (suits && column.name != target) choices.push_back(column.name);
  }
  return choices;
}

std::string column_of(const EffectText& text, const Input& input, const Series& data, std::string_view target) {
  const auto stated =
      std::find_if(text.columns.begin(), text.columns.end(), [&](const auto& one) { return one.first == input.role; });
  const Effect& effect = *text.effect;
  if (stated == text.columns.end()) {
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
  if (effect.level == Level::series && !input.units.empty() &&
      std::find(input.units.begin(), input.units.end(), unit) == input.units.end()) {
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

BoundEffect resolve_columns(const EffectText& text, const Series& data, std::string_view target) {
  BoundEffect bound{text.effect, {}};
  for (const Input& input : text.effect->inputs) bound.columns.push_back(column_of(text, input, data, target));
  return bound;
}

}  // namespace ballbar
