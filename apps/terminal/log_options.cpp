#include "terminal/log_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/recipe_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar {
namespace {

using Recipe = std::shared_ptr<LogRecipes>;

constexpr const char* kLogGroup = "Reading a log (default: detected)";

// COLUMN=VALUE; the header of a column may itself hold a =.
CLI::Validator pairs() {
  return {[](const std::string& text) {
            const std::size_t at = text.rfind('=');
            const bool whole = at != std::string::npos && at > 0 && at + 1 < text.size();
            return whole ? std::string() : fmt::format("expected COLUMN=VALUE, found {}", in_quotes(text));
          },
          ""};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return {[words](const std::string& text) {
            if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
            return fmt::format("expected one of {}, found {}", fmt::join(words, ", "), in_quotes(text));
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

// A value is put into the recipes as it is read, and the words that state it.
using Take = std::function<void(LogRecipe& recipe, const std::string& text)>;

void state(LogRecipes& recipes, const std::vector<std::string>& words, const Take& take) {
  for (LogRecipe* const recipe : {recipes.first.get(), recipes.others.get()}) {
    take(*recipe, words.back());
    recipe->words.insert(recipe->words.end(), words.begin(), words.end());
  }
  recipes.others->may_lack_columns = true;
  recipes.others->join.clear();
}

std::function<void(const std::string& text)> into(const Recipe& recipes, const std::string& name, const Take& take) {
  return [recipes, name, take](const std::string& text) { state(*recipes, {name, text}, take); };
}

CLI::Option* add(CLI::App& command, const Recipe& recipe, const std::string& name, const std::string& help,
                 const std::string& holds, const Take& take) {
  return command.add_option_function<std::string>(name, into(recipe, name, take), help)
      ->type_name(holds)
      ->group(kLogGroup);
}

void add_flag(CLI::App& command, const Recipe& recipe, const std::string& name, const std::string& help,
              bool LogRecipe::*member) {
  command
      .add_flag_callback(
          name,
          [recipe, name, member] {
            state(*recipe, {name}, [member](LogRecipe& to, const std::string&) { to.*member = true; });
          },
          help)
      ->group(kLogGroup);
}

CLI::Option* add_repeated(CLI::App& command, const Recipe& recipe, const std::string& name, const std::string& help,
                          const std::string& holds, const Take& take) {
  return command
      .add_option_function<std::vector<std::string>>(
          name,
          [one = into(recipe, name, take)](const std::vector<std::string>& texts) {
            std::for_each(texts.begin(), texts.end(), one);
          },
          help + "; may be repeated")
      ->type_name(holds)
      ->allow_extra_args(false)
      ->group(kLogGroup);
}

ColumnRecipe& column_of(LogRecipe& recipe, const std::string& source) {
  const auto found = std::find_if(recipe.columns.begin(), recipe.columns.end(),
                                  [&](const ColumnRecipe& one) { return one.source == source; });
  if (found != recipe.columns.end()) return *found;
  return recipe.columns.emplace_back(ColumnRecipe{source, "", "", std::nullopt, false});
}

void add_of_column(CLI::App& command, const Recipe& recipe, const std::string& name, const std::string& help,
                   const std::string& holds, const std::function<void(ColumnRecipe&, const std::string&)>& take) {
  add_repeated(command, recipe, name, help, holds, [take](LogRecipe& to, const std::string& pair) {
    const std::size_t at = pair.rfind('=');
    take(column_of(to, pair.substr(0, at)), pair.substr(at + 1));
  })->check(pairs());
}

Role role_of(const std::string& name) {
  if (const auto role = role_from_name(name)) return *role;
  std::vector<std::string_view> known;
  for (int role = 0; role <= static_cast<int>(Role::measured); ++role)
    known.push_back(name_of(static_cast<Role>(role)));
  throw Error(fmt::format("--role: expected one of {}, found {}; the nearest is {}.", fmt::join(known, ", "),
                          in_quotes(name), nearest_name(name, known)));
}

template <std::size_t kSize>
void add_sign(CLI::App& command, const Recipe& recipe, const std::string& name, const std::string& help,
              const std::pair<std::string_view, char> (&signs)[kSize], std::optional<char> LogRecipe::*member) {
  const std::vector<std::string> words = names_of(signs);
  const auto take = [&signs, member](LogRecipe& to, const std::string& word) {
    for (const auto& [known, sign] : signs) {
      if (known == word) to.*member = sign;
    }
  };
  add(command, recipe, name, help, fmt::format("{}", fmt::join(words, "|")), take)->check(one_of(words));
}

// Where the table is and how its cells are written.
void add_table_options(CLI::App& command, const Recipe& recipe) {
  add(command, recipe, "--recipe", "read the log by this recipe, written by import --save", "FILE",
      [](LogRecipe& to, const std::string& file) {
        to = read_recipe(read_bytes(file, kLargestText), file);
        to.file = file;
      });
  add(command, recipe, "--sheet",
      "sheet of a workbook, by name or number; default: all with the same columns, one run each", "SHEET",
      [](LogRecipe& to, const std::string& sheet) { to.sheet = sheet; });
  add_sign(command, recipe, "--delimiter", "separator of the values", kDelimiterNames, &LogRecipe::delimiter);
  add_sign(command, recipe, "--decimal", "decimal separator", kDecimalNames, &LogRecipe::decimal);
  add(command, recipe, "--header-line", "line that holds the names of the columns, from 1", "LINE",
      [](LogRecipe& to, const std::string& line) { to.header_line = std::stoul(line); })
      ->check(CLI::Range(1, 1000000).description(""));
  add_repeated(command, recipe, "--missing", "text or number that marks a missing value", "TEXT",
               [](LogRecipe& to, const std::string& text) { to.missing.push_back(text); });
  add_flag(command, recipe, "--skip-bad-rows", "skip any number of rows without numbers", &LogRecipe::skip_bad_rows);
  add_repeated(command, recipe, "--join", "add the columns of another file, row by row", "FILE",
               [](LogRecipe& to, const std::string& file) { to.join.push_back(file); });
}

void add_time_options(CLI::App& command, const Recipe& recipe) {
  add(command, recipe, "--time", "column of time; none: number the rows", "COLUMN",
      [](LogRecipe& to, const std::string& column) { to.time = column; });
  add(command, recipe, "--time-unit", "unit of a numeric time", "us|ms|s|min|h|d",
      [](LogRecipe& to, const std::string& unit) { to.time_unit = unit; })
      ->check(one_of({"us", "ms", "s", "min", "h", "d"}));
  const auto take_order = [](LogRecipe& to, const std::string& order) { to.month_first = order == "month-first"; };
  add(command, recipe, "--dates", "order of day and month in dates such as 03/04/2026", "day-first|month-first",
      take_order)
      ->check(one_of({"day-first", "month-first"}));
  command
      .add_option_function<double>(
          "--every",
          [recipe](double every_s) {
            state(*recipe, {"--every", fmt::format("{}s", every_s)},
                  [every_s](LogRecipe& to, const std::string&) { to.every_s = every_s; });
          },
          "interval of rows without a time, or of tests in a folder: 10ms, 1s, 1min")
      ->type_name("TIME")
      ->transform(
          CLI::AsNumberWithUnit(
              std::map<std::string, double>{{"us", 1e-6}, {"ms", 1e-3}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}},
              CLI::AsNumberWithUnit::CASE_SENSITIVE)
              .description(""))
      ->check(number_above_0())
      ->group(kLogGroup);
  add_flag(command, recipe, "--burst-means", "average each burst of rows to one row", &LogRecipe::burst_means);
}

void add_column_options(CLI::App& command, const Recipe& recipe) {
  add_of_column(command, recipe, "--unit", "unit of a column, 'Probe X=mm', or of several, 'T*=degC'", "COLUMN=UNIT",
                [](ColumnRecipe& column, const std::string& unit) { column.unit = unit; });
  add_of_column(command, recipe, "--scale", "size of one count of a column, 'mcu_pos_z=2.5um'", "COLUMN=SCALE",
                [](ColumnRecipe& column, const std::string& scale) { column.unit = scale; });
  add_of_column(command, recipe, "--role", "role of a column, 'T3=ambient'", "COLUMN=ROLE",
                [](ColumnRecipe& column, const std::string& role) { column.role = role_of(role); });
  add_of_column(command, recipe, "--name", "new name of a column in the series", "COLUMN=NAME",
                [](ColumnRecipe& column, const std::string& name) { column.name = name; });
  add_repeated(command, recipe, "--leave-out", "omit a column", "COLUMN",
               [](LogRecipe& to, const std::string& source) { column_of(to, source).left_out = true; });
}

// The recipes of the command, with its options where it has none yet; nullptr of a program without them.
Recipe recipes_of(CLI::App& command) {
  CommandLine* const line = line_of(command);
  if (line == nullptr) return nullptr;
  Recipe& recipes = line->recipes[&command];
  if (recipes != nullptr) return recipes;
  recipes = std::make_shared<LogRecipes>();
  recipes->first = std::make_shared<LogRecipe>();
  recipes->others = std::make_shared<LogRecipe>();
  recipes->others->may_lack_columns = true;
  add_table_options(command, recipes);
  add_time_options(command, recipes);
  add_column_options(command, recipes);
  return recipes;
}

// What takes the words of a place for data: its first file is read by the first recipe, where it is the command's first
// place.
std::function<Source(const std::string& word, bool is_first)> reading(CLI::App& command) {
  const Recipe recipes = recipes_of(command);
  const bool is_first_place = recipes != nullptr && !std::exchange(recipes->has_place, true);
  return [&command, recipes, is_first_place](const std::string& word, bool is_first) {
    Source source = source_of(command, word);
    if (recipes != nullptr) source.set_recipe(is_first_place && is_first ? recipes->first : recipes->others);
    return source;
  };
}

}  // namespace

CLI::Option* add_data(CLI::App& command, const std::string& name, Source& source, const std::string& help) {
  return command.add_option_function<std::string>(
      name, [&source, read = reading(command)](const std::string& word) { source = read(word, true); }, help);
}

CLI::Option* add_data(CLI::App& command, const std::string& name, std::vector<Source>& sources,
                      const std::string& help) {
  return command.add_option_function<std::vector<std::string>>(
      name,
      [&sources, read = reading(command)](const std::vector<std::string>& words) {
        sources.clear();
        for (const std::string& word : words) sources.push_back(read(word, sources.empty()));
      },
      help);
}

void forget_places(CLI::App& command) {
  if (const auto recipes = recipes_of(command)) recipes->has_place = false;
}

}  // namespace ballbar
