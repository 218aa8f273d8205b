// The type of each column of a log: time, numbers, or ignored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/logs/log.hpp"
#include "logs/log_shape.hpp"
#include "logs/time_stamp.hpp"

namespace ballbar {

// `channel`: the names of channels below each other; `label`: the name or unit of the column beside it.
// words: of states, such as "ROUGH"; its values are their places in LogTable::words. part: a number of hours, minutes,
// milliseconds ... of the time; year, month, day: numbers of the date; half_day: AM or PM beside a clock.
enum class ColumnKind : std::uint8_t {
  number,
  words,
  stamp,
  date,
  clock,
  part,
  year,
  month,
  day,
  half_day,
  channel,
  label,
  left_out
};

struct PlannedColumn {
  std::string source;  // header as written; "column 3" where there is none
  std::string name;    // without its unit
  std::string unit;    // as written
  bool headed = true;  // has a header
  ColumnKind kind = ColumnKind::left_out;
  bool is_switch = false;        // number: its words for on and off are 1 and 0
  bool is_speed = false;         // number: a word for off, such as "stop", is 0
  std::string before, behind;    // number: what stands in each cell besides it, "S" or "°C"
  double part_s = 0.0;           // part: its unit
  bool has_ids = false;          // channel: its names are numbers
  std::string why;               // why it is left out
  ColumnRecipe stated;           // from the recipe; `source` is empty if it states nothing
  bool unit_by_pattern = false;  // such a unit has less weight than name and values
};

struct TimePlan {
  enum class Kind : std::uint8_t { rows, number, stamps };
  Kind kind = Kind::rows;
  std::size_t column = 0;               // number: which; stamps: the first
  double unit_s = 1.0;                  // number
  double resolution_s = 0.0;            // to which a number is rounded when it became seconds; 0: kept as it is
  std::optional<double> zero_s;         // number: seconds from 1970 to its zero, where it starts at a date
  double every_s = 0.0;                 // rows
  bool numbered = false;                // rows without a clock
  std::string likely;                   // numbered: a column that rises in every row
  std::optional<DateOrder> order;       // stamps; empty: not known yet
  bool minutes_and_seconds = false;     // stamps without hours
  bool dotted_clock = false;            // 07.05.00 is a clock
  bool two_fields_are_minutes = false;  // 05:10 is five minutes
  bool two_fields_are_hours = false;    // 05:10 is five hours, and only hours that run on can tell
  std::string text;                     // "Zeit, dd.mm.yyyy hh:mm:ss"
};

struct LogPlan {
  std::vector<PlannedColumn> columns;  // one a column of the log
  TimePlan time;
  std::map<std::string, std::string> channel_units;  // of channels below each other
};

// Whether the column is the time, as a number.
bool is_time(const LogPlan& plan, std::size_t column);

// Whether the text has the form of the pattern: * any signs, ? one.
bool suits(std::string_view pattern, std::string_view text);

// What the recipe says of each column, a name before a pattern with * and ?. `units`: as the file states them.
struct StatedColumn {
  ColumnRecipe column;           // `source` is empty if nothing is said of it
  bool unit_by_pattern = false;  // such a unit has less weight than name and values
};
std::vector<StatedColumn> stated_columns(const LogRecipe& recipe, const Headers& headers,
                                         const std::vector<std::string>& units);

// Throws Error with name:line for a column of the recipe that is not there, or that several may be.
void expect_recipe_columns(const Headers& headers, const std::string& name, std::size_t line, const LogRecipe& recipe);

// Throws Error with name:line where the time cannot be told, or the layout.
LogPlan log_plan(const LogShape& shape, const std::string& name, const LogRecipe& recipe);

}  // namespace ballbar
