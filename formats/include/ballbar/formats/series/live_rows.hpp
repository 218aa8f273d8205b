// Reads the rows of a series `.csv` as they arrive, from a pipe or from a file that a logger is writing.
//
// The first line that is neither empty nor a comment (`#`) has the names of the columns: time_s or time_min and any
// others, in any order, with or without quotes. Every line after it is a row. A faulty row is not an error: a cell that
// is not a number is NaN. In a line with a wrong number of cells, or of more than 64 KiB, all cells and the time are
// NaN; a compensator then holds.
//
// Bytes may arrive in pieces of any length. After the longest line neither add() nor next() allocates memory.
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
  std::vector<double> values;  // in the order of the requested columns
};

class LiveRows {
 public:
  // `name` is used in messages.
  LiveRows(std::string name, std::vector<std::string> columns);

  void add(std::string_view bytes);

  // The next whole line as a row, valid until the next call; nullptr: more bytes are needed. Throws Error with
  // name:line: no time in the first line, a requested column that is missing (with the nearest name), duplicate or the
  // time itself, a first line of more than 64 KiB.
  const LiveRow* next();

  // Call at the end of the data: returns a last line without a line break. Throws Error if no line named the columns.
  const LiveRow* last();

  bool named() const { return cells_ > 0; }

  // Number of bytes from the first one to the end of the last line read.
  std::uint64_t taken() const { return taken_; }

 private:
  const LiveRow* take(std::string_view line);
  void name_columns(std::string_view line);

  std::string name_;
  std::vector<std::string> columns_;
  std::string bytes_;  // unread from begin_ on
  std::size_t begin_ = 0;
  std::size_t searched_ = 0;  // no line break before this position
  bool too_long_ = false;     // skip the rest of this line
  std::size_t line_ = 0;
  std::uint64_t taken_ = 0;
  std::size_t cells_ = 0;            // of a row
  double second_ = 1.0;              // seconds per unit of the time column
  std::vector<std::size_t> target_;  // for each cell: index into values, kTime or kOther
  LiveRow row_;
};

}  // namespace ballbar
