// The rows of a log as numbers.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "logs/log_plan.hpp"
#include "logs/log_shape.hpp"

namespace ballbar {

inline constexpr double kGap = std::numeric_limits<double>::quiet_NaN();  // where a row has no value

struct LogTable {
  std::vector<std::vector<double>> values;                 // one a column of the log; of numbers alone; a gap is NaN
  std::vector<double> time_s;                              // of stamps: from midnight of `first_day`; of rows: empty
  std::optional<std::int64_t> first_day;                   // since 1970
  bool elapsed = false;                                    // of the clocks: they count from a start, not from midnight
  bool zoned = false;                                      // the clock states its zone: no summer time, no doubt
  std::vector<std::pair<std::size_t, std::size_t>> lines;  // (row, line) wherever lines were passed over
  std::size_t rows = 0, other_lines = 0, without_time = 0, short_rows = 0;
  std::vector<std::size_t> bad_lines;  // skipped; where rows are counted, a row of gaps each
  std::vector<std::size_t> cut_lines;  // that end within a number, which is a gap
  std::size_t without_row = 0;         // lines between the first row and the last that are no row

  [[nodiscard]] std::size_t line_of(std::size_t row) const;
};

// Skips rows in which a cell is no number, or that have too many cells, two and one in a hundred; all by the recipe.
// Throws Error with name:line where there are more, or where dates can be read in two ways.
LogTable log_table(const Source& source, const LogShape& shape, LogPlan& plan, const LogRecipe& recipe);

}  // namespace ballbar
