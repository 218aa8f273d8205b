// What a user states about a log (log.hpp) in addition to its file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// What a user states about one column of the log.
struct ColumnRecipe {
  std::string source;        // its header, with or without unit; "T*": all matching columns without unit and role
  std::string name;          // in the series; empty: derived from the header
  std::string unit;          // as written in the log, or a scale: "2.5um"; empty: detected
  std::optional<Role> role;  // nullopt: detected
  bool left_out = false;

  bool operator==(const ColumnRecipe&) const = default;
};

// By how much the clock of a log is set later, as its dates are of another time zone.
struct LogShift {
  std::string file;  // its name, with or without the folder, or a pattern: "room*.csv"
  double shift_s = 0.0;

  bool operator==(const LogShift&) const = default;
};

// What a user states about a log. Empty members are detected. `ballbar import --save` stores one for the next log.
struct LogRecipe {
  std::string file;                  // the recipe file; empty: none
  std::vector<std::string> words;    // the words of the command line that state it
  std::string sheet;                 // of a workbook; empty: the first one with a table
  std::optional<char> delimiter;     // ' ': runs of blanks
  std::optional<char> decimal;       // ',' or '.'
  std::optional<bool> month_first;   // 03/04/2026 is the fourth of March
  std::size_t header_line = 0;       // line of the names, from 1; what is above is not read; 0: detected
  std::string time;                  // header of the time column; "none": rows are numbered
  std::string time_unit;             // for numeric times: "s", "ms", "min", "h", "d"
  std::optional<double> every_s;     // interval of the rows without a time column
  std::vector<std::string> missing;  // further texts that mean a missing value
  bool may_lack_columns = false;     // ignore columns below that the file lacks
  bool skip_bad_rows = false;        // any number of them; false: two plus one in a hundred
  bool burst_means = false;          // replace each burst of rows by its mean
  std::vector<std::string> join;     // files with further columns, row by row
  std::vector<LogShift> shifts;
  std::vector<ColumnRecipe> columns;

  bool operator==(const LogRecipe&) const = default;
};

}  // namespace ballbar
