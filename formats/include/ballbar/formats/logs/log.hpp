// Reads logs of data loggers and people as a series: a table of numbers over time in any delimited text, .xlsx, .mat or
// JSON.
//
// The reader detects what the file does not state: encoding, delimiter, decimal sign, start of the table, names, units,
// dates, gaps, roles. If two interpretations are possible it throws an error with the line and the option that decides.
// Lengths become um, temperatures degC, spindle speeds rpm, powers W. A column without a unit stays as it is, except
// temperatures that name and values identify. The rows of a log without a clock are numbered (Series::has_clock).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/text/log_recipe.hpp"
#include "ballbar/formats/text/source.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// A column of the log and how it was interpreted.
struct LogColumn {
  std::string source;      // its header in the log
  std::string name;        // in the series; empty: left out
  std::string found_unit;  // as the log writes it
  std::string unit;        // in the series: "um"; empty: none
  Role role = Role::event;
  bool role_is_stated = false;  // the recipe states it
  std::string why;              // the reason for the role, or for leaving it out
  std::size_t gaps = 0;         // cells without a value
  std::vector<double> first;    // its first values, at most five; a gap is NaN
};

struct Log {
  Series series;
  std::vector<LogColumn> columns;  // in the order of the log, without the time
  std::string time;                // in words: where the time comes from
  std::string shape;               // in words: "semicolons, decimal comma, Windows-1252"
  std::size_t first_row_line = 0;
  std::string names_from;            // in words: "names from line 2, units from line 3"; empty: right above the rows
  std::vector<std::string> remarks;  // whole sentences: possible faults, repairs, assumptions
  std::vector<std::string> unclear;  // whole sentences: what a user should state
  std::vector<std::size_t> skipped_lines;  // numbers of the lines that are not rows of numbers
  std::size_t without_row = 0;             // lines between the first and the last row that are not rows
  std::string sheet;                       // workbook: the sheet that was read
  std::vector<std::string> sheets;         // workbook: all sheets
  LogRecipe recipe;                        // complete, with everything detected
};

// `name` is used in messages. Throws Error with name:line: what was expected, what was found, which option helps.
Log read_log(std::string_view bytes, const std::string& name, const LogRecipe& recipe = {});

// The same for a file, with the recipe of the source. The file is not held in memory.
Log open_log(const Source& source);

// The sheets of a workbook that have a table, in their order.
struct WorkbookSheets {
  std::vector<std::string> alike;   // the largest group with the same column names
  std::vector<std::string> others;  // sheets with other column names
};

// Empty for any other file. Throws Error if the workbook is damaged.
WorkbookSheets sheets_of(const Source& source);

inline constexpr std::size_t kShownRows = 5;

// Sets the first values, at most kShownRows, and the gaps of a column.
void show_values(LogColumn& column, std::span<const double> values);

// Applies what a user states about the columns of a series that is not a log: roles, names, missing units, columns to
// leave out. Throws Error with `name` for a column that it does not have.
Series with_stated_columns(Series series, const LogRecipe& recipe, const std::string& name);

// By how much a recipe sets the clock of the file `name` later, in s; 0: not stated.
double stated_shift_s(const LogRecipe& recipe, const std::string& name);

// Converts Series::started to seconds since 1970 and back, without a zone. nullopt: not a date with a time.
std::optional<double> seconds_of_stamp(std::string_view started);
std::string stamp_text(double seconds);

// One line for people: how the log was interpreted.
std::string sentence_of(const Log& log);

}  // namespace ballbar
