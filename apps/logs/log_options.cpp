#include "logs/log_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/recipe_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar {
namespace {

CLI::Option* repeated(CLI::App& command, const std::string& name, std::vector<std::string>& to, const std::string& help,
                      const std::string& holds) {
  return command.add_option(name, to, help)->type_name(holds)->allow_extra_args(false);
}

// COLUMN=VALUE; the header of a column may itself hold a =.
CLI::Validator pairs() {
  return {[](const std::string& text) {
            const std::size_t at = text.rfind('=');
            const bool whole = at != std::string::npos && at > 0 && at + 1 < text.size();
            return whole ? std::string() : fmt::format("expected COLUMN=VALUE, found {}", in_quotes(text));
          },
          ""};
}

template <std::size_t kSize>
std::vector<std::string> names_of(const std::pair<std::string_view, char> (&signs)[kSize]) {
  std::vector<std::string> names;
  names.reserve(kSize);
  for (const auto& [name, sign] : signs) names.emplace_back(name);
  return names;
}

template <class Set>
void of_columns(const std::vector<std::string>& pairs, LogRecipe& recipe, Set set) {
  for (const std::string& pair : pairs) {
    const std::size_t at = pair.rfind('=');
    const std::string source = pair.substr(0, at), value = pair.substr(at + 1);
    auto found = std::find_if(recipe.columns.begin(), recipe.columns.end(),
                              [&](const ColumnRecipe& one) { return one.source == source; });
    if (found == recipe.columns.end()) found = recipe.columns.insert(found, {source, "", "", std::nullopt, false});
    set(*found, value);
  }
}

}  // namespace

void add_log_options(CLI::App& command, LogOptions& options) {
  const std::string group = "How the log is read, where it does not tell";
  command.add_option("--recipe", options.recipe, "recipe.toml of an earlier --save")->type_name("FILE")->group(group);
  command.add_option("--sheet", options.sheet, "of a workbook, by name or number; default the first")
      ->type_name("SHEET")
      ->group(group);
  command.add_option("--delimiter", options.delimiter, "what stands between the values")
      ->check(CLI::IsMember(names_of(kDelimiterNames)))
      ->type_name("")
      ->group(group);
  command.add_option("--decimal", options.decimal, "sign of decimals")
      ->check(CLI::IsMember(names_of(kDecimalNames)))
      ->type_name("")
      ->group(group);
  command.add_option("--dates", options.dates, "how 03/04/2026 is read")
      ->check(CLI::IsMember({"day-first", "month-first"}))
      ->type_name("")
      ->group(group);
  command.add_option("--time", options.time, "column of the time")->type_name("COLUMN")->group(group);
  command.add_option("--time-unit", options.time_unit, "of a time that is a number: us, ms, s, min, h or d")
      ->check(CLI::IsMember({"us", "ms", "s", "min", "h", "d"}))
      ->type_name("")
      ->group(group);
  CLI::Option* every =
      command.add_option("--every", options.every_s, "distance of the rows where there is no time: 10ms, 1s, 1min");
  every->type_name("TIME")
      ->transform(CLI::AsNumberWithUnit(
          std::map<std::string, double>{{"us", 1e-6}, {"ms", 1e-3}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}},
          CLI::AsNumberWithUnit::CASE_SENSITIVE))
      ->check(number_above_0())
      ->group(group);
  repeated(command, "--missing", options.missing, "a text that stands for no value; may be repeated", "TEXT")
      ->group(group);
  repeated(command, "--unit", options.units, "unit of a column as a log writes it, 'Probe X=mm'; may be repeated",
           "COLUMN=UNIT")
      ->check(pairs())
      ->group(group);
  repeated(command, "--role", options.roles, "role of a column, 'T3=ambient'; may be repeated", "COLUMN=ROLE")
      ->check(pairs())
      ->group(group);
  repeated(command, "--name", options.names, "name of a column in the series; may be repeated", "COLUMN=NAME")
      ->check(pairs())
      ->group(group);
  repeated(command, "--leave-out", options.left_out, "a column that is not wanted; may be repeated", "COLUMN")
      ->group(group);
}

LogRecipe recipe_of(const LogOptions& options) {
  LogRecipe recipe;
  if (!options.recipe.empty()) recipe = read_recipe(read_bytes(options.recipe, kLargestText), options.recipe);
  const auto take = [](const std::string& from, std::string& to) {
    if (!from.empty()) to = from;
  };
  take(options.sheet, recipe.sheet);
  take(options.time, recipe.time);
  take(options.time_unit, recipe.time_unit);
  for (const auto& [name, sign] : kDelimiterNames) {
    if (name == options.delimiter) recipe.delimiter = sign;
  }
  for (const auto& [name, sign] : kDecimalNames) {
    if (name == options.decimal) recipe.decimal = sign;
  }
  if (!options.dates.empty()) recipe.month_first = options.dates == "month-first";
  if (options.every_s) recipe.every_s = options.every_s;
  recipe.missing.insert(recipe.missing.end(), options.missing.begin(), options.missing.end());
  of_columns(options.units, recipe, [](ColumnRecipe& column, const std::string& unit) { column.unit = unit; });
  of_columns(options.names, recipe, [](ColumnRecipe& column, const std::string& name) { column.name = name; });
  of_columns(options.roles, recipe, [](ColumnRecipe& column, const std::string& name) {
    column.role = role_from_name(name);
    if (column.role) return;
    std::vector<std::string_view> known;
    for (int role = 0; role <= static_cast<int>(Role::measured); ++role)
      known.push_back(name_of(static_cast<Role>(role)));
    throw Error(fmt::format("--role: expected one of {}, found {}; the nearest is {}.", fmt::join(known, ", "),
                            in_quotes(name), nearest_name(name, known)));
  });
  for (const std::string& source : options.left_out) {
    of_columns({source + "=out"}, recipe, [](ColumnRecipe& column, const std::string&) { column.left_out = true; });
  }
  return recipe;
}

}  // namespace ballbar
