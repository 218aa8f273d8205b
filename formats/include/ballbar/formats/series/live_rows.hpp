// Rows of a series `.csv` as they arrive: from a pipe, or a file that a logger still writes.
//
// The first line that is neither empty nor a comment (`#`) names the columns, time_s or time_min among them, in any
// order and with any others, in quotes or without; after it every line is a row. What a row lacks is no error: a cell
// that is no number, and every cell of a line with another number of cells, is NaN, and so is its time; a compensator
// holds then. A line of more than 64 KiB counts as such a row.
//
// Bytes may come in any pieces. Once the longest line has come, neither add() nor next() takes memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

struct LiveRow {
  double time_s = 0.0;
  std::vector<double> values;  // as the columns that were wanted
};

class LiveRows {
 public:
  // `name` stands in messages.
  LiveRows(std::string name, std::vector<std::string> columns);

  void add(std::string_view bytes);

  // The next whole line as a row, until the next call; nullptr: more bytes are needed. Throws Error with name:line:
  // no time in the first line, a wanted column that it lacks (with the nearest) or has twice or that is the time, a
  // first line of more than 64 KiB.
  const LiveRow* next();

  // No more will come: a last line without an end counts. Throws Error where no line named the columns.
  const LiveRow* last();

  bool named() const { return cells_ > 0; }

  // Bytes up to the end of the last line that was taken, from the first byte on.
  std::uint64_t taken() const { return taken_; }

 private:
  const LiveRow* take(std::string_view line);
  void name_columns(std::string_view line);

  std::string name_;
  std::vector<std::string> columns_;
  std::string bytes_;  // from begin_ on not yet read
  std::size_t begin_ = 0;
  std::size_t searched_ = 0;  // up to here is no end of a line
  bool too_long_ = false;     // the rest of this line is skipped
  std::size_t line_ = 0;
  std::uint64_t taken_ = 0;
  std::size_t cells_ = 0;            // of a row
  double second_ = 1.0;              // of the time column's unit
  std::vector<std::size_t> target_;  // of a cell: place in values, kTime or kOther
  LiveRow row_;
};

}  // namespace ballbar
