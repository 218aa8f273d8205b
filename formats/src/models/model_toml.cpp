#include "ballbar/formats/models/model_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/model/model.hpp"
#include "models/model_text.hpp"
#include "text/head.hpp"
#include "text/located_text.hpp"
#include "text/readers.hpp"
#include "text/table_place.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kModelFormat = "ballbar-model 1";
constexpr std::string_view kRecordingTarget = "deviation_um";
constexpr std::size_t kMostEffects = 100;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr Key kRootKeys[] = {
    {"format", "text", "\"ballbar-model 1\"; needed"},
    {"target", "text or texts",
     "column to explain, or several, each by its own fit; recordings: `deviation_um`; a series needs it"},
    {"level", "text", "\"series\", the default, or \"recording\""},
    {"constant_um", "um", "series: the constant is held there; without it, it is free"},
    {"trained", "table", "`NAME = [lowest, highest]` of each column while the model was fitted; above the effects"},
    {"effect", "tables", "an effect each; at most 100"},
    {"history", "tables", "the ledger, which `add` and `undo` write; below the effects"},
};
constexpr Key kNameKeys[] = {
    {"name", "text", "effect, as `ballbar effects` lists it; needed"},
};
constexpr Key kFormulaKeys[] = {
    {"name", "text", "\"expression\""},
    {"formula", "text", "formula in um; see `ballbar effects expression`; needed"},
};
constexpr Key kSettingKeys[] = {
    {"start", "its unit", "where the fit starts; default: the catalogue's"},
    {"lower", "its unit", "lowest value; default: the catalogue's"},
    {"upper", "its unit", "highest value; default: the catalogue's"},
};
constexpr Key kOwnSettingKeys[] = {
    {"start", "its unit", "where the fit starts; needed"},
    {"lower", "its unit", "lowest value; default: none"},
    {"upper", "its unit", "highest value; default: none"},
    {"unit", "text", "stands in the results; default \"1\""},
    {"held", "true or false", "true: it stays at its start; default false"},
};

// A finite number, or the infinity of that side.
std::optional<double> bound(const TomlTable& table, std::string_view key, double infinity) {
  const toml::node* node = table.table->get(key);
  if (node && node->is_floating_point() && node->as_floating_point()->get() == infinity) return infinity;
  return number(table, key);
}

void expect_in_order(const TomlTable& table, std::string_view key, std::string_view parameter, double lower,
                     double upper) {
  if (lower < upper) return;
  fail_at_key(table, key,
              fmt::format("expected lower below upper for {}, found lower {} and upper {}.", parameter, lower, upper));
}

// What a key of an effect's table says of a parameter whose own values are in `setting`.
Setting setting_at(const TomlTable& table, const std::string& key, Setting setting, bool own, std::string& unit) {
  const toml::node* node = table.table->get(key);
  if (node == nullptr) return setting;
  setting.stated = true;
  if (node->is_number()) {
    setting.held = true;
    setting.start = *number(table, key);
    if (setting.start < setting.lower || setting.start > setting.upper) {
      fail_at_key(table, key,
                  fmt::format("expected a value from {} to {} for {}, found {}.", setting.lower, setting.upper, key,
                              setting.start));
    }
    return setting;
  }
  if (!node->is_table()) {
    fail_kind(table, key, "a number, which is held, or { start, lower, upper }, which is free from there,");
  }
  const TomlTable free = *subtable(table, key);
  expect_keys(free, own ? std::span<const Key>(kOwnSettingKeys) : kSettingKeys);
  setting.held = own && boolean(free, "held").value_or(false);
  if (own) unit = string(free, "unit").value_or("1");
  setting.lower = bound(free, "lower", -kInfinity).value_or(setting.lower);
  setting.upper = bound(free, "upper", kInfinity).value_or(setting.upper);
  expect_in_order(free, has(free, "lower") ? "lower" : "upper", key, setting.lower, setting.upper);
  const std::optional<double> start = number(free, "start");
  if (!start && own) {
    fail_at_key(table, key, fmt::format("expected start in the table of the parameter {}, found none.", key));
  }
  setting.stated = start.has_value();
  setting.start = start.value_or(setting.start);
  if (setting.start < setting.lower || setting.start > setting.upper) {
    fail_at_key(free, "start",
                fmt::format("expected a start from {} to {} for {}, found {}{}.", setting.lower, setting.upper, key,
                            setting.start, start ? "" : ", which the catalogue has"));
  }
  return setting;
}

// The column under a role's key. On recordings columns bind by themselves.
std::string column_at(const TomlTable& table, const Effect& effect, const std::string& role) {
  if (const std::optional<std::string> column = string(table, role)) {
    if (column->empty())
      fail_at_key(table, role, fmt::format("expected the name of a column for {}, found \"\".", role));
    return *column;
  }
  if (effect.level == Level::recording) return std::string(trace_column(role));
  std::vector<std::string_view> roles;
  for (const Input& input : effect.inputs) roles.push_back(input.role);
  fail_at_table(table,
                fmt::format("expected a column for each role of {}, {} {}, found none for {} in {}.", effect.name,
                            roles.size() == 1 ? "which is" : "which are", fmt::join(roles, ", "), role, table.label));
}

Term catalogue_term(const TomlTable& table, const std::string& name, Level level, const Catalogue& catalogue) {
  Term term;
  try {
    term = term_of(name, {}, level, catalogue);
  } catch (const Error& error) {
    fail_at_key(table, "name", error.what());
  }
  const Effect& effect = *term.effect;
  std::vector<std::string_view> known = names_of(kNameKeys);
  for (const Input& input : effect.inputs) known.push_back(input.role);
  for (const Parameter& parameter : effect.parameters) known.push_back(parameter.name);
  expect_keys(table, known);
  term.columns.clear();
  for (const Input& input : effect.inputs) term.columns.push_back(column_at(table, effect, input.role));
  std::string unit;
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    term.settings[k] = setting_at(table, effect.parameters[k].name, term.settings[k], false, unit);
  }
  return term;
}

// A number or a table in an expression's own is a parameter, which its formula must have.
void expect_in_formula(const TomlTable& table, const std::vector<std::string>& names) {
  const toml::key* first = nullptr;
  for (const auto& [key, value] : *table.table) {
    if (!value.is_number() && !value.is_table()) continue;
    if (key == "name" || key == "formula" || std::find(names.begin(), names.end(), key.str()) != names.end()) continue;
    if (first == nullptr || key.source().begin.line < first->source().begin.line) first = &key;
  }
  if (first == nullptr) return;
  const std::string expected = fmt::format("expected the parameter {} in the formula, found", in_quotes(first->str()));
  if (names.empty()) fail_at_key(table, first->str(), fmt::format("{} no names in it.", expected));
  constexpr std::size_t kMostListed = 30;
  const std::vector<std::string_view> known(names.begin(), names.end());
  fail_at_key(table, first->str(),
              fmt::format("{} {} in it; the nearest is {}.", expected,
                          known.size() > kMostListed ? fmt::format("{} others", known.size())
                                                     : fmt::format("{}", fmt::join(known, ", ")),
                          nearest_name(first->str(), known)));
}

Term own_term(const TomlTable& table, Level level) {
  const std::string formula = required(string, table, "formula");
  std::vector<std::string> names;
  try {
    names = names_in(formula);
  } catch (const Error& error) {
    fail_at_key(table, "formula", error.what());
  }
  std::vector<std::string_view> known = names_of(kFormulaKeys);
  known.insert(known.end(), names.begin(), names.end());
  expect_in_formula(table, names);
  expect_keys(table, known);
  std::vector<Parameter> parameters;
  for (const std::string& name : names) {
    if (!has(table, name) || name == "name" || name == "formula") continue;
    Parameter parameter{.name = name, .unit = "1", .meaning = "parameter of the formula"};
    const Setting setting = setting_at(table, name, {.lower = -kInfinity, .upper = kInfinity}, true, parameter.unit);
    parameter.start = setting.start;
    parameter.lower = setting.lower;
    parameter.upper = setting.upper;
    parameter.held = setting.held;
    parameters.push_back(std::move(parameter));
  }
  try {
    return expression_term(formula, std::move(parameters), level);
  } catch (const Error& error) {
    fail_at_key(table, "formula", error.what());
  }
}

std::vector<std::string> targets_at(const TomlTable& root, Level level) {
  const toml::node* node = root.table->get("target");
  if (node == nullptr && level == Level::recording) return {std::string(kRecordingTarget)};
  if (node == nullptr) fail_missing(root, "target");
  if (!node->is_string() && !node->is_array()) fail_kind(root, "target", "the name of a column or an array of names");
  if (node->is_string()) {
    if (node->as_string()->get().empty()) fail_kind(root, "target", "the name of a column");
    return {node->as_string()->get()};
  }
  std::vector<std::string> targets = *strings(root, "target");
  if (targets.empty()) fail_at_key(root, "target", "expected at least one column for target, found none.");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto before = targets.begin() + static_cast<std::ptrdiff_t>(i);
    if (targets[i].empty()) fail_at_element(root, "target", i, "expected the name of a column for target, found \"\".");
    if (std::find(targets.begin(), before, targets[i]) != before) {
      fail_at_element(root, "target", i,
                      fmt::format("expected each target once, found {} again.", in_quotes(targets[i])));
    }
  }
  return targets;
}

// [trained]: what each column was while the model was fitted. Above the effects, which come and go.
std::vector<ColumnRange> trained_at(const TomlTable& root) {
  const std::optional<TomlTable> table = subtable(root, "trained");
  if (!table) return {};
  const std::vector<TomlTable> effects = subtables(root, "effect");
  if (!effects.empty() && is_before(effects.front(), *table)) {
    fail_at_table(*table, "expected [trained] above the effects, found it below one.");
  }
  std::vector<const toml::key*> keys;  // in the order of the file
  for (const auto& [key, value] : *table->table) keys.push_back(&key);
  std::sort(keys.begin(), keys.end(), [](const toml::key* a, const toml::key* b) {
    return std::pair(a->source().begin.line, a->source().begin.column) <
           std::pair(b->source().begin.line, b->source().begin.column);
  });
  std::vector<ColumnRange> trained;
  for (const toml::key* key : keys) {
    const std::vector<double> range = *numbers(*table, key->str());
    if (range.size() != 2 || !(range[0] <= range[1])) {
      fail_at_key(*table, key->str(),
                  fmt::format("expected the lowest and the highest value of {}, found {}.", key->str(),
                              range.size() == 2 ? fmt::format("{} and {}", range[0], range[1])
                                                : fmt::format("{} numbers", range.size())));
    }
    trained.push_back({std::string(key->str()), range[0], range[1]});
  }
  return trained;
}

Model model_of(const TomlTable& root, const Catalogue& catalogue) {
  expect_format(root, kModelFormat);
  expect_keys(root, kRootKeys);
  Model model;
  const std::string_view levels[] = {"series", "recording"};
  if (choice_index(root, "level", levels).value_or(0) == 1) model.level = Level::recording;
  model.targets = targets_at(root, model.level);
  model.constant_um = number(root, "constant_um");
  if (model.constant_um && model.level == Level::recording) {
    fail_at_key(root, "constant_um", "expected no constant_um on recordings, whose circle has it, found one.");
  }
  model.trained = trained_at(root);
  const std::vector<TomlTable> tables = subtables(root, "effect");
  if (tables.size() > kMostEffects) {
    fail_at_table(tables[kMostEffects],
                  fmt::format("expected at most {} effects, found {}.", kMostEffects, tables.size()));
  }
  for (const TomlTable& table : tables) {
    const std::string name = required(string, table, "name");
    model.terms.push_back(name == "expression" ? own_term(table, model.level)
                                               : catalogue_term(table, name, model.level, catalogue));
  }
  subtables(root, "history");  // whatever its rows say
  return model;
}

bool same_bounds(const Setting& setting, const Parameter& parameter) {
  return setting.lower == parameter.lower && setting.upper == parameter.upper;
}

}  // namespace

std::string setting_text(const Setting& setting, const Parameter& parameter, bool own) {
  const bool unit = own && parameter.unit != "1";
  if (setting.held && !own && parameter.held && setting.start == parameter.start) return "";
  if (setting.held && !unit) return toml_number(setting.start);
  const bool start = own || setting.stated || setting.start != parameter.start;
  const bool as_in_catalogue = !own && same_bounds(setting, parameter);
  if (!start && as_in_catalogue && !parameter.held) return "";
  std::vector<std::string> parts;
  if (start) parts.push_back("start = " + toml_number(setting.start));
  if (own ? std::isfinite(setting.lower) : !as_in_catalogue) parts.push_back("lower = " + toml_number(setting.lower));
  if (own ? std::isfinite(setting.upper) : !as_in_catalogue) parts.push_back("upper = " + toml_number(setting.upper));
  if (unit) parts.push_back("unit = " + toml_quoted(parameter.unit));
  if (setting.held) parts.emplace_back("held = true");
  return parts.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

std::string effect_text(const Term& term) {
  const Effect& effect = *term.effect;
  const bool own = effect.name == "expression";
  std::string out = fmt::format("[[effect]]\nname = {}\n", toml_quoted(effect.name));
  if (own) out += fmt::format("formula = {}\n", toml_quoted(effect.explanation.formula));
  for (std::size_t i = 0; i < effect.inputs.size() && !own; ++i) {
    const std::string& role = effect.inputs[i].role;
    if (effect.level == Level::recording && term.columns[i] == trace_column(role)) continue;
    out += fmt::format("{} = {}\n", role, toml_quoted(term.columns[i]));
  }
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const std::string value = setting_text(term.settings[k], effect.parameters[k], own);
    if (!value.empty()) out += fmt::format("{} = {}\n", toml_key(effect.parameters[k].name), value);
  }
  return out;
}

std::vector<KeyTable> model_keys() {
  return {{"", kRootKeys},
          {"`[[effect]]`, beside its inputs and parameters", kNameKeys},
          {"A parameter of it, where it is free", kSettingKeys},
          {"`[[effect]]` with a formula, beside the parameters of that", kFormulaKeys},
          {"A parameter of the formula", kOwnSettingKeys}};
}

constinit const Reader readers::kModel = {
    .found = "a model",
    .is_yours = [](std::string_view head) { return format_name(head) == "ballbar-model"; },
};

Model read_model(std::string_view bytes, std::string_view name, const Catalogue& catalogue) {
  const SourceText text = source_text(bytes, name);
  const TomlSource source = parse_toml(text.bytes, name);
  return model_of(root_of(source), catalogue);
}

std::string write_model(const Model& model) {
  std::string out = fmt::format("format = \"{}\"\n", kModelFormat);
  if (model.level == Level::recording) out += "level = \"recording\"\n";
  std::vector<std::string> targets;
  for (const std::string& target : model.targets) targets.push_back(toml_quoted(target));
  out += targets.size() == 1 ? fmt::format("target = {}\n", targets[0])
                             : fmt::format("target = [{}]\n", fmt::join(targets, ", "));
  if (model.constant_um) out += fmt::format("constant_um = {}\n", toml_number(*model.constant_um));
  if (!model.trained.empty()) out += "\n[trained]\n";
  for (const ColumnRange& range : model.trained) {
    out += fmt::format("{} = [{}, {}]\n", toml_key(range.column), toml_number(range.low), toml_number(range.high));
  }
  for (const Term& term : model.terms) {
    if (!term.effect->rules.of_set_up) out += "\n" + effect_text(term);
  }
  return out;
}

std::string with_effect(std::string_view bytes, std::string_view name, const Term& term, const Catalogue& catalogue) {
  const SourceText text = source_text(bytes, name);
  const TomlSource source = parse_toml(text.bytes, name);
  const TomlTable root = root_of(source);
  static_cast<void>(model_of(root, catalogue));
  const std::vector<TomlTable> effects = subtables(root, "effect");
  if (!effects.empty() && !has_header(text.bytes, effects[0])) {
    fail_at_table(effects[0], "expected effects as tables [[effect]], to which one can be added, found an array.");
  }
  std::size_t at = text.bytes.size();
  const std::vector<TomlTable> history = subtables(root, "history");
  if (!history.empty() && has_header(text.bytes, history[0]) &&
      (effects.empty() || is_before(effects.back(), history[0]))) {
    at = start_with_comments(text.bytes, history[0]);
  }
  const std::size_t skipped = bytes.size() - text.bytes.size();  // the byte order mark
  std::string result(bytes.substr(0, skipped + at));
  if (!result.ends_with('\n')) result += '\n';
  if (!result.ends_with("\n\n")) result += '\n';
  result += effect_text(term);
  if (at < text.bytes.size()) result += '\n';
  return result.append(text.bytes.substr(at));
}

}  // namespace ballbar
