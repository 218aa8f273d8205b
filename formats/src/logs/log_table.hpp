// The rows of a log as numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "logs/log_plan.hpp"
#include "logs/log_shape.hpp"

namespace ballbar {

inline constexpr double kGap = std::numeric_limits<double>::quiet_NaN();  // where a row has no value

// More are remarks, not states.
inline constexpr std::size_t kMostStates = 9;

struct LogTable {
  std::vector<std::vector<double>> values;      // one a column of the log; of numbers and words; a gap is NaN
  std::vector<std::vector<std::string>> words;  // of columns of words: those that differ, kMostStates at most
  std::vector<double> time_s;                   // of stamps: from midnight of `first_day`; of rows: empty
  std::optional<std::int64_t> first_day;        // since 1970
  bool has_clock = false;                       // a stamp has a time of day
  bool lacks_year = false;                      // of the dates
  bool elapsed = false;                         // times count from a start, not from midnight
  bool zoned = false;                           // the clock states its zone, so that there is no summer time
  std::vector<std::pair<std::size_t, std::size_t>> lines;  // (row, line) after each group of skipped lines
  std::size_t rows = 0, other_lines = 0, without_time = 0, short_rows = 0;
  std::vector<std::size_t> bad_lines;     // skipped; where rows are counted, a row of gaps each
  std::vector<std::size_t> cut_lines;     // lines that end within a number, which becomes a gap
  std::vector<std::string> channels;      // below each other, in the order of the file
  std::vector<std::uint32_t> channel_of;  // one a row
  std::vector<std::string> gap_words;     // words that stand again and again where a number is expected: gaps
  std::size_t without_row = 0;            // lines between the first and the last row that are not rows
  std::size_t before_clock = 0;           // rows that were written before the clock was set; they are left out

  [[nodiscard]] std::size_t line_of(std::size_t row) const;
};

// Keeps these rows, in this order.
void keep_rows(const std::vector<std::size_t>& rows, LogTable& table);

// Skips rows with a cell that is not a number, or with too many cells: up to two plus one in a hundred, or all with the
// recipe's option. Throws Error with name:line if there are more, or if dates are ambiguous.
LogTable log_table(const Source& source, const LogShape& shape, LogPlan& plan, const LogRecipe& recipe);

}  // namespace ballbar
