#include "model/resolve_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/internal/nearest_name.hpp"

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

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// "T room", "temperature=T room"
std::string with_column_name(const std::string& part, const Series& data) {
  const std::string named = column_named(data, part);
  const std::size_t equals = part.find('=');
  if (named != part || equals == std::string::npos) return named;
  return part.substr(0, equals + 1) + column_named(data, trimmed(part.substr(equals + 1)));
}

}  // namespace

BoundEffect resolve_columns(const EffectText& text, const Series& data, std::string_view target) {
  BoundEffect bound{text.effect, {}};
  for (const Input& input : text.effect->inputs) bound.columns.push_back(column_of(text, input, data, target));
  return bound;
}

std::string with_column_names(const std::string& effect, const Series& data) {
  const std::size_t begin = effect.find_first_of(":(");
  if (begin == std::string::npos) return effect;
  const bool brackets = effect[begin] == '(';
  const std::size_t end = std::min(brackets ? effect.rfind(')') : effect.size(), effect.size());
  std::string text = effect.substr(0, begin + 1);
  bool changed = false;
  for (std::size_t from = begin + 1; from < end;) {
    const std::size_t to = std::min(effect.find(',', from), end);
    const std::string part = trimmed(effect.substr(from, to - from)), named = with_column_name(part, data);
    changed = changed || named != part;
    if (from > begin + 1) text += brackets ? ", " : ",";
    text += named;
    from = to + 1;
  }
  return changed ? text + effect.substr(end) : effect;
}

}  // namespace ballbar
