// Tables of numbers: common parts of the log reader and the series reader.
//
// A table is a line of column names and rows of numbers, separated by commas. It is scanned once, in
// memory, with std::from_chars, without a string or a vector per row.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/located_text.hpp"

namespace ballbar {

// The block of lines starting with `#` at the top, each with its `#` blanked: TOML whose lines and columns
// are those of the file. Throws Error where the block is longer than 1 MiB.
struct CommentBlock {
  std::string toml;
  std::size_t end = 0;  // offset of the first line after it
};
CommentBlock comment_block(const SourceText& text);

struct ColumnName {
  std::string name;
  std::size_t offset = 0;
};

struct TableHead {
  std::vector<ColumnName> columns;  // 1 to 10 000, all different
  std::size_t body = 0;             // offset of the first row
};
TableHead table_head(const SourceText& text, std::size_t offset);

// Throws Error: "expected a column NAME, found none.", where the column is not there.
void expect_column(const SourceText& text, const TableHead& head, bool is_there, std::string_view name);

// All rows, column by column, at least one row. gaps: an empty cell outside the first column is NaN.
std::vector<std::vector<double>> table_columns(const SourceText& text, const TableHead& head, bool gaps);

// Throws Error at a cell, with what the cell holds: "expected EXPECTED, found "CELL"."
[[noreturn]] void fail_at_cell(const SourceText& text, const TableHead& head, std::size_t row, std::size_t column,
                               std::string_view expected);

// Throws Error at the first time that does not rise.
void expect_rising(const SourceText& text, const TableHead& head, std::size_t column, std::span<const double> time);

}  // namespace ballbar
