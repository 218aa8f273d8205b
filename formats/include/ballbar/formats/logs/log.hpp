// Logs as loggers and people write them: a table of numbers over time in any delimited text, .xlsx, .mat or JSON, taken
// for a series.
//
// What the file does not say is found out: encoding, delimiter, decimal sign, where the table begins, names, units,
// dates, gaps, roles. Two readings that are both possible are refused with the line and the option that tells them
// apart. Lengths become um, temperatures degC, spindle speeds rpm, powers W; a column without a unit stays as it is.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/text/source.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// What a user knows of one column of the log.
struct ColumnRecipe {
  std::string source;        // its header, with or without the unit
  std::string name;          // in the series; empty: made from the header
  std::string unit;          // as written in the log; empty: found out
  std::optional<Role> role;  // empty: found out
  bool left_out = false;
};

// What a user knows of a log; all that is empty is found out. `ballbar import --save` keeps one for the next log.
struct LogRecipe {
  std::string sheet;                 // of a workbook; empty: the first
  std::optional<char> delimiter;     // ' ': runs of blanks
  std::optional<char> decimal;       // ',' or '.'
  std::optional<bool> month_first;   // 03/04/2026 is the fourth of March
  std::string time;                  // header of the column of time
  std::string time_unit;             // "s", "ms", "min", "h", "d" of a time that is a number
  std::optional<double> every_s;     // no column of time: rows so far apart
  std::vector<std::string> missing;  // cells that hold no value, besides the usual ones
  std::vector<ColumnRecipe> columns;
};

// A column of the log and what it was taken for.
struct LogColumn {
  std::string source;      // its header in the log
  std::string name;        // in the series; empty where it is left out
  std::string found_unit;  // as the log writes it
  std::string unit;        // of the series: "um"; empty where there is none
  Role role = Role::event;
  std::string why;       // what tells the role, or why it is left out
  std::size_t gaps = 0;  // cells without a value
};

struct Log {
  Series series;
  std::vector<LogColumn> columns;  // of the log, in its order, that of the time left out
  std::string time;                // what the time was taken from, in words
  std::string shape;               // how the text was read, in words: "semicolons, decimal comma, Windows-1252"
  std::size_t first_row_line = 0;
  std::vector<std::string> remarks;  // whole sentences: what looks broken, what was mended
  LogRecipe recipe;                  // with all that was found out
};

// `name` stands in messages. Throws Error with name:line: what was expected, what was found, which option mends it.
Log read_log(std::string_view bytes, const std::string& name, const LogRecipe& recipe = {});

// The same of a file, which is not held in memory.
Log open_log(const Source& source, const LogRecipe& recipe = {});

// Of Series::started: seconds from 1970 to it and back, without a zone; nullopt for what is no date with a clock.
std::optional<double> seconds_of_stamp(std::string_view started);
std::string stamp_text(double seconds);

// One line for people: what the log was taken for.
std::string sentence_of(const Log& log);

}  // namespace ballbar
