// What a user knows of a log (log.hpp) that its file does not tell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// What a user knows of one column of the log.
struct ColumnRecipe {
  std::string source;  // its header, with or without the unit; "T*": all columns like this that state no unit, no role
  std::string name;    // in the series; empty: made from the header
  std::string unit;    // as written in the log, or a scale: "2.5um" a unit; empty: found out
  std::optional<Role> role;  // empty: found out
  bool left_out = false;

  bool operator==(const ColumnRecipe&) const = default;
};

// What a user knows of a log; all that is empty is found out. `ballbar import --save` keeps one for the next log.
struct LogRecipe {
  std::string file;                  // that it was read from; empty: none
  std::vector<std::string> words;    // of a command line that state it
  std::string sheet;                 // of a workbook; empty: the first that holds a table
  std::optional<char> delimiter;     // ' ': runs of blanks
  std::optional<char> decimal;       // ',' or '.'
  std::optional<bool> month_first;   // 03/04/2026 is the fourth of March
  std::string time;                  // header of the column of time; "none": rows are numbered
  std::string time_unit;             // "s", "ms", "min", "h", "d" of a time that is a number
  std::optional<double> every_s;     // no column of time: rows so far apart
  std::vector<std::string> missing;  // cells that hold no value, besides the usual ones
  bool may_lack_columns = false;     // columns below that a file has not are passed over
  bool skip_bad_rows = false;        // however many; without it two and one in a hundred
  bool burst_means = false;          // rows that come in bursts: one row a burst, the mean of its rows
  std::vector<std::string> join;     // files whose columns stand beside these, row by row; of no recipe file
  std::vector<ColumnRecipe> columns;

  bool operator==(const LogRecipe&) const = default;
};

}  // namespace ballbar
