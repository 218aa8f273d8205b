#include "ballbar/model/effect_argument.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/model/bound_effect.hpp"
#include "ballbar/nearest_name.hpp"
#include "model/bindings.hpp"

namespace ballbar {
namespace {

using Choice = std::pair<std::string, std::string>;  // role and column

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
  std::vector<std::string> expected;
  for (const Input& input : effect.inputs) {
    expected.push_back(fmt::format("{}{}", input.role,
                                   input.units.empty() ? "" : fmt::format(" in {}", fmt::join(input.units, " or "))));
  }
  throw Error(fmt::format("{}: expected columns of the data for {}{}, found none that suit.", effect.name,
                          fmt::join(expected, " and "), choices.empty() ? "" : " beside those named"));
}

}  // namespace

Term term_from_text(std::string_view text, const Model& model, const Series& data, const Catalogue& catalogue) {
  const auto [named, choices, settings] = effect_text(text, model.level, &data, catalogue);
  Term term = term_of(named->name, {}, model.level, catalogue);
  for (const auto& [parameter, setting] : settings) term.settings[parameter] = setting;
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
      if (listed.size() < kListed) listed.push_back(label_of(BoundEffect{&effect, columns}));
    }
    const std::string more = bindings.size() > kListed ? fmt::format(" and {} more", bindings.size() - kListed) : "";
    throw Error(fmt::format("{}: expected columns, for which the data offer {} choices: {}{}.", effect.name,
                            bindings.size(), fmt::join(listed, ", "), more));
  }
  term.columns = std::move(bindings.front());
  return term;
}

std::vector<BoundEffect> choices_of(const Effect& effect, const Model& model, const Series& data) {
  std::vector<BoundEffect> choices;
  if (needs_clock(effect) && !data.has_clock) return choices;
  for (std::vector<std::string>& columns : bindings_of(effect, model, data)) {
    if (!has_term(model, effect, columns)) choices.push_back({&effect, std::move(columns)});
  }
  return choices;
}

}  // namespace ballbar
