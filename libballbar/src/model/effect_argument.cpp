#include "ballbar/model/effect_argument.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "model/bindings.hpp"

namespace ballbar {
namespace {

using Choice = std::pair<std::string, std::string>;  // role and column

std::vector<std::string_view> parts_of(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> roles_of(const Effect& effect) {
  std::vector<std::string_view> roles;
  for (const Input& input : effect.inputs) roles.push_back(input.role);
  return roles;
}

std::vector<Choice> choices_of(std::string_view text, const Effect& effect) {
  const std::vector<std::string_view> roles = roles_of(effect);
  std::vector<Choice> choices;
  for (const std::string_view part : parts_of(text, ',')) {
    const std::size_t equals = part.find('=');
    const std::string_view role = part.substr(0, equals);
    if (equals == std::string_view::npos || role.empty() || equals + 1 == part.size()) {
      throw Error(fmt::format("{}: expected role=column, found {}.", effect.name, in_quotes(part)));
    }
    if (roles.empty()) {
      throw Error(
          fmt::format("{}: expected no columns, which it does not read, found {}.", effect.name, in_quotes(part)));
    }
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      throw Error(fmt::format("{}: expected a role, one of {}, found {}; the nearest is {}.", effect.name,
                              fmt::join(roles, ", "), in_quotes(role), nearest_name(role, roles)));
    }
    const auto same = [&](const Choice& choice) { return choice.first == role; };
    if (std::any_of(choices.begin(), choices.end(), same)) {
      throw Error(fmt::format("{}: expected each role once, found {} again.", effect.name, role));
    }
    choices.emplace_back(role, part.substr(equals + 1));
  }
  return choices;
}

// "lagged_expansion:temperature=T_air_degC"
std::string text_of(const Effect& effect, const std::vector<std::string>& columns) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < columns.size(); ++i)
    parts.push_back(fmt::format("{}={}", effect.inputs[i].role, columns[i]));
  return fmt::format("{}:{}", effect.name, fmt::join(parts, ","));
}

bool associations(const Effect& effect, const std::vector<std::string>& columns, const std::vector<Choice>& choices) {
  return std::all_of(choices.begin(), choices.end(), [&](const Choice& choice) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (effect.inputs[i].role == choice.first && columns[i] == choice.second) return true;
    }
    return false;
  });
}

void expect_in_data(const Effect& effect, const std::vector<Choice>& choices, const Series& data) {
  for (const auto& [role, column] : choices) {
    if (find_column(data, column) != nullptr) continue;
    std::vector<std::string_view> known;
    for (const Column& candidate : data.columns) known.push_back(candidate.name);
    throw Error(fmt::format("{}: expected a column of the data for {}, found {}; the nearest is {}.", effect.name, role,
                            in_quotes(column), nearest_name(column, known)));
  }
}

[[noreturn]] void fail_without_column(const Effect& effect, const Model& model, const Series& data,
                                      const std::vector<Choice>& choices) {
  if (choices.empty() && !bindings_of(effect, model, data).empty()) {
    throw Error(fmt::format("{}: expected a choice of columns that is not in the model yet, found none.", effect.name));
  }
  std::vector<std::string> wanted;
  for (const Input& input : effect.inputs) {
    wanted.push_back(fmt::format("{}{}", input.role,
                                 input.units.empty() ? "" : fmt::format(" in {}", fmt::join(input.units, " or "))));
  }
  throw Error(fmt::format("{}: expected columns of the data for {}{}, found none that suit.", effect.name,
                          fmt::join(wanted, " and "), choices.empty() ? "" : " beside those named"));
}

}  // namespace

EffectText effect_text(std::string_view text, Level level, const Catalogue& catalogue) {
  const std::size_t colon = text.find(':');
  EffectText result{term_of(text.substr(0, colon), {}, level, catalogue).effect.get(), {}};
  if (colon == std::string_view::npos) return result;
  const std::string_view rest = text.substr(colon + 1);
  if (level == Level::recording) {
    throw Error(fmt::format("{}: expected no columns on recordings, where they bind by themselves, found {}.",
                            result.effect->name, in_quotes(rest)));
  }
  result.columns = choices_of(rest, *result.effect);
  return result;
}

Term term_from_text(std::string_view text, const Model& model, const Series& data, const Catalogue& catalogue) {
  const auto [named, choices] = effect_text(text, model.level, catalogue);
  Term term = term_of(named->name, {}, model.level, catalogue);
  const Effect& effect = *term.effect;
  if (effect.inputs.empty() || model.level == Level::recording) return term;
  expect_in_data(effect, choices, data);
  term.columns.clear();
  if (choices.size() == effect.inputs.size()) {  // whether they suit is for expect_suits
    for (const Input& input : effect.inputs) {
      const auto choice = std::find_if(choices.begin(), choices.end(),
                                       [&](const Choice& candidate) { return candidate.first == input.role; });
      term.columns.push_back(choice->second);
    }
    return term;
  }
  std::vector<std::vector<std::string>> bindings;
  for (std::vector<std::string>& columns : bindings_of(effect, model, data)) {
    if (has_term(model, effect, columns) || !associations(effect, columns, choices)) continue;
    bindings.push_back(std::move(columns));
  }
  if (bindings.empty()) fail_without_column(effect, model, data, choices);
  if (bindings.size() > 1) {
    constexpr std::size_t kListed = 20;
    std::vector<std::string> listed;
    for (const std::vector<std::string>& columns : bindings) {
      if (listed.size() < kListed) listed.push_back(text_of(effect, columns));
    }
    const std::string more = bindings.size() > kListed ? fmt::format(" and {} more", bindings.size() - kListed) : "";
    throw Error(fmt::format("{}: expected columns, for which the data offer {} choices: {}{}.", effect.name,
                            bindings.size(), fmt::join(listed, " "), more));
  }
  term.columns = std::move(bindings.front());
  return term;
}

}  // namespace ballbar
