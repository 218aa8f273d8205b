// Logs as loggers and people write them: a table of numbers over time in any delimited text, .xlsx, .mat or JSON, taken
// for a series.
//
// What the file does not say is found out: encoding, delimiter, decimal sign, where the table begins, names, units,
// dates, gaps, roles. Two readings that are both possible are refused with the line and the option that tells them
// apart. Lengths become um, temperatures degC, spindle speeds rpm, powers W; a column without a unit stays as it is,
// but for temperatures that name and values tell. A log without a clock has numbered rows (Series::has_clock).
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

// A column of the log and what it was taken for.
struct LogColumn {
  std::string source;      // its header in the log
  std::string name;        // in the series; empty where it is left out
  std::string found_unit;  // as the log writes it
  std::string unit;        // of the series: "um"; empty where there is none
  Role role = Role::event;
  bool role_is_stated = false;  // by the recipe
  std::string why;              // what tells the role, or why it is left out
  std::size_t gaps = 0;         // cells without a value
  std::vector<double> first;    // its first values, at most five; a gap is NaN
};

struct Log {
  Series series;
  std::vector<LogColumn> columns;  // of the log, in its order, that of the time left out
  std::string time;                // what the time was taken from, in words
  std::string shape;               // how the text was read, in words: "semicolons, decimal comma, Windows-1252"
  std::size_t first_row_line = 0;
  std::vector<std::string> remarks;        // whole sentences: what looks broken, what was mended, what was assumed
  std::vector<std::string> unclear;        // whole sentences: what a user should state
  std::vector<std::size_t> skipped_lines;  // numbers of the lines that are no rows of numbers
  std::size_t without_row = 0;             // lines between the first row and the last that are no row
  std::string sheet;                       // of a workbook: the one that was read
  std::vector<std::string> sheets;         // all of it
  LogRecipe recipe;                        // with all that was found out
};

// `name` stands in messages. Throws Error with name:line: what was expected, what was found, which option mends it.
Log read_log(std::string_view bytes, const std::string& name, const LogRecipe& recipe = {});

// The same of a file, by its own recipe; it is not held in memory.
Log open_log(const Source& source);

// Sheets of a workbook with a table, in their order.
struct WorkbookSheets {
  std::vector<std::string> alike;   // under the same names, the most that have the same
  std::vector<std::string> others;  // under other names
};

// None of another file. Throws Error where it is damaged.
WorkbookSheets sheets_of(const Source& source);

inline constexpr std::size_t kShownRows = 5;

// Sets the first values, at most kShownRows, and the gaps of a column.
void show_values(LogColumn& column, std::span<const double> values);

// What a user states of the columns of a series that is no log: roles, names, units where there is none, what is left
// out. Throws Error with `name` where it has no such column.
Series with_stated_columns(Series series, const LogRecipe& recipe, const std::string& name);

// Of Series::started: seconds from 1970 to it and back, without a zone; nullopt for what is no date with a clock.
std::optional<double> seconds_of_stamp(std::string_view started);
std::string stamp_text(double seconds);

// One line for people: what the log was taken for.
std::string sentence_of(const Log& log);

}  // namespace ballbar
