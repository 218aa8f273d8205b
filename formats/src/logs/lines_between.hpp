// The lines of a log that are not rows: names and dates that belong to the rows behind them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "logs/log_shape.hpp"

namespace ballbar {

class LinesBetween {
 public:
  // Both stay with the caller. name: of the file, for errors.
  LinesBetween(const LogShape& shape, const std::string& name) : shape_(shape), name_(name) {}

  // The line of names of the table.
  void take_names(std::string_view line) { names_ = line; }

  // Whether the line begins as the names do: loggers write them again where they are switched on again.
  [[nodiscard]] bool repeats_names(std::string_view line) const;

  // Compares such a line with the names.
  void look_for_names(std::string_view line, std::size_t number);

  // Looks for a date in a line that is not a row, of a log whose rows have a clock alone.
  void look_for_date(std::string_view line, std::size_t number, bool rows_are_above);

  // Call for each row. Throws Error if the row follows other names, or another date than the rows above. goes_back: the
  // clock of the row is before that of the last row.
  void expect_same_table(bool goes_back);

 private:
  const LogShape& shape_;
  const std::string& name_;
  std::string names_;
  std::string new_names_;        // the error if a row follows
  std::set<std::int64_t> days_;  // since 1970
  std::size_t date_line_ = 0;    // of a new date since the last row
  bool is_next_day_ = false;     // it is the day after one of `days_`
};

}  // namespace ballbar
