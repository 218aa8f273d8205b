#include "terminal/log_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/recipe_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar {
namespace {

using Recipe = std::shared_ptr<LogRecipe>;
constexpr const char* kGroup = "How a log is read, where it does not tell";

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

// A value is put into the recipe as it is read.
CLI::Option* add(CLI::App& command, const std::string& name, const std::string& help, const std::string& holds,
                 const std::function<void(const std::string&)>& take) {
  return command.add_option_function<std::string>(name, take, help)->type_name(holds)->group(kGroup);
}

CLI::Option* add_repeated(CLI::App& command, const std::string& name, const std::string& help, const std::string& holds,
                          const std::function<void(const std::string&)>& take) {
  return command
      .add_option_function<std::vector<std::string>>(
          name, [take](const std::vector<std::string>& texts) { std::for_each(texts.begin(), texts.end(), take); },
          help + "; may be repeated")
      ->type_name(holds)
      ->allow_extra_args(false)
      ->group(kGroup);
}

ColumnRecipe& column_of(LogRecipe& recipe, const std::string& source) {
  const auto found = std::find_if(recipe.columns.begin(), recipe.columns.end(),
                                  [&](const ColumnRecipe& one) { return one.source == source; });
  if (found != recipe.columns.end()) return *found;
  return recipe.columns.emplace_back(ColumnRecipe{source, "", "", std::nullopt, false});
}

void add_of_column(CLI::App& command, const std::string& name, const std::string& help, const std::string& holds,
                   const Recipe& recipe, const std::function<void(ColumnRecipe&, const std::string&)>& take) {
  add_repeated(command, name, help, holds, [recipe, take](const std::string& pair) {
    const std::size_t at = pair.rfind('=');
    take(column_of(*recipe, pair.substr(0, at)), pair.substr(at + 1));
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
void add_sign(CLI::App& command, const std::string& name, const std::string& help,
              const std::pair<std::string_view, char> (&signs)[kSize], const Recipe& recipe,
              std::optional<char> LogRecipe::*member) {
  add(command, name, help, "", [&signs, recipe, member](const std::string& word) {
    for (const auto& [known, sign] : signs) {
      if (known == word) (*recipe).*member = sign;
    }
  })->check(CLI::IsMember(names_of(signs)));
}

// Where the table is and how its cells are written.
void add_table_options(CLI::App& command, const Recipe& recipe) {
  add(command, "--recipe", "recipe.toml of an earlier import --save", "FILE", [recipe](const std::string& file) {
    *recipe = read_recipe(read_bytes(file, kLargestText), file);
    recipe->file = file;
  });
  add(command, "--sheet", "of a workbook, by name or number; default: all that are alike, a run each", "SHEET",
      [recipe](const std::string& sheet) { recipe->sheet = sheet; });
  add_sign(command, "--delimiter", "what stands between the values", kDelimiterNames, recipe, &LogRecipe::delimiter);
  add_sign(command, "--decimal", "sign of decimals", kDecimalNames, recipe, &LogRecipe::decimal);
  add_repeated(command, "--missing", "a text that stands for no value", "TEXT",
               [recipe](const std::string& text) { recipe->missing.push_back(text); });
  command
      .add_flag_callback(
          "--skip-bad-rows", [recipe] { recipe->skip_bad_rows = true; },
          "skip rows that are none of numbers, however many; without it two and one in a hundred")
      ->group(kGroup);
  add_repeated(command, "--join", "a file whose columns stand beside these, row by row, sheet by sheet", "FILE",
               [recipe](const std::string& file) { recipe->join.push_back(file); });
}

void add_time_options(CLI::App& command, const Recipe& recipe) {
  add(command, "--time", "column of the time; none: the rows are numbered", "COLUMN",
      [recipe](const std::string& column) { recipe->time = column; });
  add(command, "--time-unit", "of a time that is a number: us, ms, s, min, h or d", "",
      [recipe](const std::string& unit) { recipe->time_unit = unit; })
      ->check(CLI::IsMember({"us", "ms", "s", "min", "h", "d"}));
  add(command, "--dates", "how 03/04/2026 is read", "", [recipe](const std::string& order) {
    recipe->month_first = order == "month-first";
  })->check(CLI::IsMember({"day-first", "month-first"}));
  command
      .add_option_function<double>(
          "--every", [recipe](double every_s) { recipe->every_s = every_s; },
          "distance of the rows where there is no time: 10ms, 1s, 1min")
      ->type_name("TIME")
      ->transform(CLI::AsNumberWithUnit(
          std::map<std::string, double>{{"us", 1e-6}, {"ms", 1e-3}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}},
          CLI::AsNumberWithUnit::CASE_SENSITIVE))
      ->check(number_above_0())
      ->group(kGroup);
  command
      .add_flag_callback(
          "--burst-means", [recipe] { recipe->burst_means = true; },
          "rows that come in bursts: one row a burst, the mean of its rows")
      ->group(kGroup);
}

void add_column_options(CLI::App& command, const Recipe& recipe) {
  add_of_column(command, "--unit", "unit of a column as a log writes it, 'Probe X=mm', or of all like it, 'T*=degC'",
                "COLUMN=UNIT", recipe, [](ColumnRecipe& column, const std::string& unit) { column.unit = unit; });
  add_of_column(command, "--scale", "what a unit of a column is, 'mcu_pos_z=2.5um'", "COLUMN=SCALE", recipe,
                [](ColumnRecipe& column, const std::string& scale) { column.unit = scale; });
  add_of_column(command, "--role", "role of a column, 'T3=ambient'", "COLUMN=ROLE", recipe,
                [](ColumnRecipe& column, const std::string& role) { column.role = role_of(role); });
  add_of_column(command, "--name", "name of a column in the series", "COLUMN=NAME", recipe,
                [](ColumnRecipe& column, const std::string& name) { column.name = name; });
  add_repeated(command, "--leave-out", "a column that is not wanted", "COLUMN",
               [recipe](const std::string& source) { column_of(*recipe, source).left_out = true; });
}

// The recipe of the command, with its options where it has none yet; nullptr of a program without them.
Recipe recipe_of(CLI::App& command) {
  CommandLine* const line = line_of(command);
  if (line == nullptr) return nullptr;
  Recipe& recipe = line->recipes[&command];
  if (recipe != nullptr) return recipe;
  recipe = std::make_shared<LogRecipe>();
  add_table_options(command, recipe);
  add_time_options(command, recipe);
  add_column_options(command, recipe);
  return recipe;
}

}  // namespace

CLI::Option* add_data(CLI::App& command, const std::string& name, Source& source, const std::string& help) {
  return command.add_option_function<std::string>(
      name,
      [&command, &source, recipe = recipe_of(command)](const std::string& word) {
        source = source_of(command, word);
        source.set_recipe(recipe);
      },
      help);
}

CLI::Option* add_data(CLI::App& command, const std::string& name, std::vector<Source>& sources,
                      const std::string& help) {
  return command.add_option_function<std::vector<std::string>>(
      name,
      [&command, &sources, recipe = recipe_of(command)](const std::vector<std::string>& words) {
        sources.clear();
        for (const std::string& word : words) sources.emplace_back(source_of(command, word)).set_recipe(recipe);
      },
      help);
}

}  // namespace ballbar
