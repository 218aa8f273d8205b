#include "ballbar/internal/model/effect_argument.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/model/model.hpp"
#include "model/bindings.hpp"

namespace ballbar {
namespace {

std::vector<std::string_view> parts_of(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string_view without_spaces(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> whole_number_text(std::string_view text) {
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return {};
  return value;
}

std::vector<std::string_view> roles_of(const Effect& effect) {
  std::vector<std::string_view> roles;
  for (const Input& input : effect.inputs) roles.push_back(input.role);
  return roles;
}

bool takes_unit_of(const Input& input, std::string_view column) {
  return input.units.empty() || std::find(input.units.begin(), input.units.end(), unit_of(column)) != input.units.end();
}

// The words of a text between its brackets, or behind its colon, as they come.
class Arguments {
 public:
  Arguments(EffectText& result, const Series* data) : result_(result), effect_(*result.effect), data_(data) {}

  void add(std::string_view part) {
    const std::size_t equals = part.find('=');
    const bool is_column = data_ != nullptr && find_column(*data_, part) != nullptr;
    if (!is_column && is_setting(part)) return;
    if (is_column || equals == std::string_view::npos) {
      positions_.push_back(part);
    } else {
      add_role(without_spaces(part.substr(0, equals)), without_spaces(part.substr(equals + 1)), part);
    }
  }

  void add_role(std::string_view role, std::string_view column, std::string_view part) {
    const std::vector<std::string_view> roles = roles_of(effect_);
    if (role.empty() || column.empty()) {
      throw Error(fmt::format("{}: expected role=column, found {}.", effect_.name, in_quotes(part)));
    }
    expect_inputs(part);
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      throw Error(fmt::format("{}: expected a role, one of {}, found {}; the nearest is {}.", effect_.name,
                              fmt::join(roles, ", "), in_quotes(role), nearest_name(role, roles)));
    }
    if (is_named(role)) throw Error(fmt::format("{}: expected each role once, found {} again.", effect_.name, role));
    result_.columns.emplace_back(role, column);
  }

  // Columns without a role: to those that are left, in their order. Where there are fewer, one goes on to the next that
  // takes its unit.
  void bind_positions() {
    std::vector<const Input*> left;
    for (const Input& input : effect_.inputs) {
      if (!is_named(input.role)) left.push_back(&input);
    }
    if (!positions_.empty()) expect_inputs(positions_.front());
    if (positions_.size() > left.size()) {
      throw Error(fmt::format("{}: expected {} column{}, for {}, found {}.", effect_.name, effect_.inputs.size(),
                              effect_.inputs.size() == 1 ? "" : "s", fmt::join(roles_of(effect_), " and "),
                              positions_.size() + result_.columns.size()));
    }
    auto input = left.begin();
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      const auto spare = [&] { return static_cast<std::size_t>(left.end() - input) > positions_.size() - k; };
      while (spare() && !takes_unit_of(**input, positions_[k])) ++input;
      if (positions_[k].empty()) {
        throw Error(fmt::format("{}: expected a column for {}, found \"\".", effect_.name, (*input)->role));
      }
      result_.columns.emplace_back((*input)->role, positions_[k]);
      ++input;
    }
  }

  // "onset_s = 3600", "onset_s from 0 to 3600"
  bool is_setting(std::string_view part) {
    const std::string_view name = part.substr(0, part.find_first_of(" \t="));
    const auto at = std::find_if(effect_.parameters.begin(), effect_.parameters.end(),
                                 [&](const Parameter& parameter) { return parameter.name == name; });
    if (name == part || at == effect_.parameters.end()) return false;
    Setting setting{at->held, at->start, at->lower, at->upper, false};
    const std::string_view rest = without_spaces(part.substr(name.size()));
    const std::size_t to = rest.find(" to ");
    if (rest.starts_with('=')) {
      const std::optional<double> start = whole_number_text(without_spaces(rest.substr(1)));
      setting.stated = start.has_value();
      setting.start = start.value_or(at->start);
    } else if (rest.starts_with("from ") && to != std::string_view::npos && to > 4) {
      const std::optional<double> lower = whole_number_text(without_spaces(rest.substr(5, to - 4)));
      const std::optional<double> upper = whole_number_text(without_spaces(rest.substr(to + 4)));
      if (lower && upper) {
        setting.lower = *lower;
        setting.upper = *upper;
        setting.start = std::clamp(at->start, std::min(*lower, *upper), std::max(*lower, *upper));
      }
    }
    if (!setting.stated && setting.lower == at->lower && setting.upper == at->upper) {
      throw Error(fmt::format("{}: expected {} = NUMBER, or from NUMBER to NUMBER, found {}.", effect_.name, name,
                              in_quotes(part)));
    }
    result_.settings.emplace_back(static_cast<std::size_t>(at - effect_.parameters.begin()), setting);
    return true;
  }

 private:
  bool is_named(std::string_view role) const {
    return std::any_of(result_.columns.begin(), result_.columns.end(),
                       [&](const auto& one) { return one.first == role; });
  }

  void expect_inputs(std::string_view found) const {
    if (!effect_.inputs.empty()) return;
    throw Error(
        fmt::format("{}: expected no columns, which it does not read, found {}.", effect_.name, in_quotes(found)));
  }

  EffectText& result_;
  const Effect& effect_;
  const Series* data_;
  std::vector<std::string_view> positions_;
};

// "circle 2": the second recording.
bool takes_recording(EffectText& result, std::string_view text) {
  const std::optional<double> number = whole_number_text(text);
  const std::vector<Parameter>& parameters = result.effect->parameters;
  const auto at = std::find_if(parameters.begin(), parameters.end(),
                               [](const Parameter& one) { return one.shape_of == ShapeOf::recording; });
  if (!number || *number < 1.0 || *number != std::floor(*number) || at == parameters.end()) return false;
  result.settings.emplace_back(static_cast<std::size_t>(at - parameters.begin()),
                               Setting{true, *number - 1.0, at->lower, at->upper, false});
  return true;
}

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

EffectText effect_text(std::string_view text, Level level, const Series* data, const Catalogue& catalogue) {
  text = without_spaces(text);
  const std::size_t end = text.find_first_of(":( ");
  const std::string_view name = text.substr(0, end);
  if (name == "expression" && end != std::string_view::npos) {
    throw Error(
        "expression: expected an effect of the catalogue, found a formula, which stands in the model's file with the "
        "starts of its parameters.");
  }
  EffectText result{term_of(name, {}, level, catalogue).effect.get(), {}};
  if (end == std::string_view::npos) return result;
  std::string_view rest = without_spaces(text.substr(end));
  if (takes_recording(result, rest)) return result;
  const bool brackets = rest.starts_with('(') && rest.ends_with(')');
  if (!brackets && !rest.starts_with(':')) {
    throw Error(
        fmt::format("{}: expected columns in brackets, {}(COLUMN, ...), found {}.", name, name, in_quotes(rest)));
  }
  rest = brackets ? rest.substr(1, rest.size() - 2) : rest.substr(1);
  if (brackets && without_spaces(rest).empty()) return result;
  Arguments arguments(result, data);
  for (const std::string_view part : parts_of(rest, ',')) {
    const std::string_view word = without_spaces(part);
    const bool only_setting = level == Level::recording;
    if (only_setting && !arguments.is_setting(word)) {
      throw Error(fmt::format("{}: expected no columns on recordings, where they bind by themselves, found {}.",
                              result.effect->name, in_quotes(rest)));
    }
    if (only_setting) continue;
    const std::size_t equals = word.find('=');
    if (brackets) {
      arguments.add(word);
    } else if (equals == std::string_view::npos) {
      throw Error(fmt::format("{}: expected role=column, found {}.", name, in_quotes(word)));
    } else {
      arguments.add_role(word.substr(0, equals), word.substr(equals + 1), word);
    }
  }
  arguments.bind_positions();
  return result;
}

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
