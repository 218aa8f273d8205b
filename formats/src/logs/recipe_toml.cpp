#include "ballbar/formats/logs/recipe_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kFormat = "ballbar-recipe 1";

constexpr Key kRootKeys[] = {
    {"format", "text", "\"ballbar-recipe 1\"; needed"},
    {"sheet", "text", "sheet of a workbook; default: the first with a table"},
    {"delimiter", "text", "\"comma\", \"semicolon\", \"tab\", \"bar\" or \"blank\""},
    {"decimal", "text", "\"comma\" or \"point\""},
    {"dates", "text", "\"day-first\" or \"month-first\": how 03/04/2026 is read"},
    {"header_line", "whole number", "line of the names, from 1; what is above is not read; default: detected"},
    {"time", "text", "header of the column of time; \"none\": rows are numbered"},
    {"time_unit", "text", "of a time that is a number: \"s\", \"ms\", \"min\", \"h\" ..."},
    {"every_s", "s", "interval of the rows if no column holds the time, above 0"},
    {"missing", "list of texts", "cells without a value, besides the usual ones"},
    {"skip_bad_rows", "true or false", "skip any number of rows without numbers; default false"},
    {"burst_means", "true or false", "average each burst of rows to one row; default false"},
    {"join", "list of texts", "files with further columns, row by row, as `--join`"},
    {"shift", "tables", "`[[shift]]`, one per log whose clock is set, as `--shift`"},
    {"column", "tables", "`[[column]]`, one per column of the log"},
};
constexpr Key kShiftKeys[] = {
    {"file", "text", "name of the log, with or without its folder, or a pattern, \"room*.csv\"; needed"},
    {"shift_s", "s", "by which its clock is set later; below 0: earlier; needed"},
};
constexpr Key kColumnKeys[] = {
    {"source", "text", "its header in the log, with or without the unit, or a pattern, \"T*\"; needed"},
    {"name", "text", "in the series; default made from the header"},
    {"unit", "text", "as a log writes it, or a scale, \"2.5um\"; default: detected"},
    {"role", "text", "as in `[columns.NAME]` of a series; default found out"},
    {"left_out", "true or false", "default false"},
};

template <std::size_t kSize>
std::optional<char> sign(const TomlTable& table, std::string_view key,
                         const std::pair<std::string_view, char> (&signs)[kSize]) {
  std::vector<std::string_view> names;
  for (const auto& [name, one] : signs) names.push_back(name);
  const auto index = choice_index(table, key, names);
  if (!index) return std::nullopt;
  return signs[*index].second;
}

template <std::size_t kSize>
std::string_view name_of_sign(char one, const std::pair<std::string_view, char> (&signs)[kSize]) {
  return std::find_if(std::begin(signs), std::end(signs), [&](const auto& s) { return s.second == one; })->first;
}

ColumnRecipe column_of(const TomlTable& table) {
  expect_keys(table, kColumnKeys);
  ColumnRecipe column;
  column.source = required(string, table, "source");
  column.name = string(table, "name").value_or("");
  column.unit = string(table, "unit").value_or("");
  column.left_out = boolean(table, "left_out").value_or(false);
  column.role = role_choice(table, "role");
  return column;
}

}  // namespace

std::vector<KeyTable> recipe_keys() {
  return {{"", kRootKeys}, {"`[[shift]]`", kShiftKeys}, {"`[[column]]`", kColumnKeys}};
}

LogRecipe read_recipe(std::string_view bytes, std::string_view name) {
  const TomlSource source = parse_toml(bytes, name);
  const TomlTable root = root_of(source);
  expect_keys(root, kRootKeys);
  expect_format(root, kFormat);
  LogRecipe recipe;
  recipe.sheet = string(root, "sheet").value_or("");
  recipe.delimiter = sign(root, "delimiter", kDelimiterNames);
  recipe.decimal = sign(root, "decimal", kDecimalNames);
  const std::string_view orders[] = {"day-first", "month-first"};
  if (const auto order = choice_index(root, "dates", orders)) recipe.month_first = *order == 1;
  recipe.header_line = static_cast<std::size_t>(std::max<std::int64_t>(0, integer(root, "header_line").value_or(0)));
  recipe.time = string(root, "time").value_or("");
  recipe.time_unit = string(root, "time_unit").value_or("");
  recipe.every_s = positive(root, "every_s");
  recipe.missing = strings(root, "missing").value_or(std::vector<std::string>{});
  recipe.skip_bad_rows = boolean(root, "skip_bad_rows").value_or(false);
  recipe.burst_means = boolean(root, "burst_means").value_or(false);
  recipe.join = strings(root, "join").value_or(std::vector<std::string>{});
  for (const TomlTable& table : subtables(root, "shift")) {
    expect_keys(table, kShiftKeys);
    recipe.shifts.push_back({required(string, table, "file"), required(number, table, "shift_s")});
  }
  for (const TomlTable& table : subtables(root, "column")) recipe.columns.push_back(column_of(table));
  return recipe;
}

std::string write_recipe(const LogRecipe& recipe) {
  std::string out = fmt::format("format = \"{}\"\n", kFormat);
  const auto text = [&](std::string_view key, std::string_view value) {
    if (!value.empty()) out += fmt::format("{} = {}\n", key, toml_quoted(value));
  };
  text("sheet", recipe.sheet);
  if (recipe.delimiter) text("delimiter", name_of_sign(*recipe.delimiter, kDelimiterNames));
  if (recipe.decimal) text("decimal", name_of_sign(*recipe.decimal, kDecimalNames));
  if (recipe.month_first) text("dates", *recipe.month_first ? "month-first" : "day-first");
  if (recipe.header_line > 0) out += fmt::format("header_line = {}\n", recipe.header_line);
  text("time", recipe.time);
  text("time_unit", recipe.time_unit);
  if (recipe.every_s) out += fmt::format("every_s = {}\n", toml_number(*recipe.every_s));
  const auto texts = [&](std::string_view key, const std::vector<std::string>& values) {
    if (values.empty()) return;
    std::vector<std::string> quoted;
    quoted.reserve(values.size());
    for (const std::string& one : values) quoted.push_back(toml_quoted(one));
    out += fmt::format("{} = [{}]\n", key, fmt::join(quoted, ", "));
  };
  texts("missing", recipe.missing);
  if (recipe.skip_bad_rows) out += "skip_bad_rows = true\n";
  if (recipe.burst_means) out += "burst_means = true\n";
  texts("join", recipe.join);
  for (const LogShift& one : recipe.shifts)
    out += fmt::format("\n[[shift]]\nfile = {}\nshift_s = {}\n", toml_quoted(one.file), toml_number(one.shift_s));
  for (const ColumnRecipe& column : recipe.columns) {
    out += "\n[[column]]\n";
    text("source", column.source);
    text("name", column.name);
    text("unit", column.unit);
    if (column.left_out)
      out += "left_out = true\n";
    else if (column.role)
      text("role", name_of(*column.role));
  }
  return out;
}

}  // namespace ballbar
