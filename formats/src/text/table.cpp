#include "text/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLongestComments = std::size_t{1} << 20;
constexpr std::size_t kMostColumns = 10000;
constexpr std::size_t kBytesOfPart = std::size_t{1} << 20;
constexpr std::size_t kRowsBetweenQuestions = 4096;  // whether the work is to end

bool is_blank(char c) { return c == ' ' || c == '\t'; }

struct Cell {
  std::string_view text;   // trimmed
  std::size_t offset = 0;  // in the file; of an empty one where its text would begin
};

std::vector<Cell> cells_of(const TextLine& line) {
  std::vector<std::string_view> whole;
  split_cells(line.text, ',', whole);
  std::vector<Cell> cells;
  cells.reserve(whole.size());
  for (const std::string_view cell : whole) {
    const std::string_view text = trimmed(cell);
    const char* const at = text.empty() ? cell.data() : text.data();
    cells.push_back({text, line.offset + static_cast<std::size_t>(at - line.text.data())});
  }
  return cells;
}

// Why the row at `offset` is not `columns` numbers: said once, slowly.
[[noreturn]] void fail_row(const SourceText& text, const TableHead& head, std::size_t offset, bool gaps) {
  const TextLine at = line_at(text.bytes, offset);
  const std::string_view line = at.text;
  const std::size_t columns = head.columns.size();
  if (trimmed(line).empty()) {
    fail_at(text, offset, fmt::format("expected a row of {} values, found an empty line.", columns));
  }
  if (line.find_first_of(";\t") != std::string_view::npos) {
    fail_at(text, offset + line.find_first_of(";\t"),
            fmt::format("expected values separated by commas, decimals with a point, found {}.", in_quotes(line)));
  }
  const std::vector<Cell> cells = cells_of(at);
  if (cells.size() != columns) {
    fail_at(text, offset,
            fmt::format("expected {} values, one for each column, found {}{}.", columns, cells.size(),
                        cells.size() > columns ? "; decimals need a point, not a comma" : ""));
  }
  for (std::size_t column = 0; column < columns; ++column) {
    const auto [cell, place] = cells[column];
    const std::string& name = head.columns[column].name;
    double value = 0.0;
    const std::string_view digits = cell.starts_with('+') ? cell.substr(1) : cell;
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (cell.empty()) {
      if (!gaps || column == 0) fail_at(text, place, fmt::format("expected a number for {}, found nothing.", name));
    } else if (error == std::errc::result_out_of_range) {
      fail_at(text, place,
              fmt::format("expected a number that a double can hold for {}, found {}.", name, in_quotes(cell)));
    } else if (error != std::errc{} || rest != digits.data() + digits.size() || !std::isfinite(value) ||
               (digits.size() < cell.size() && digits.starts_with('-'))) {
      fail_at(text, place, fmt::format("expected a finite number for {}, found {}.", name, in_quotes(cell)));
    }
  }
  fail_at(text, offset, fmt::format("expected {} numbers separated by commas, found {}.", columns, in_quotes(line)));
}

// Whole rows, the first of them the `row`-th.
struct TablePart {
  std::string_view text;
  std::size_t row = 0, rows = 0;
};

std::vector<TablePart> parts_of(std::string_view body) {
  std::vector<TablePart> parts;
  for (std::size_t begin = 0; begin < body.size();) {
    const std::size_t line_end = body.find('\n', std::min(begin + kBytesOfPart, body.size()));
    const std::size_t end = line_end == std::string_view::npos ? body.size() : line_end + 1;
    parts.push_back({body.substr(begin, end - begin)});
    begin = end;
  }
  in_parallel(parts.size(), [&](std::size_t i) {
    const std::string_view text = parts[i].text;
    parts[i].rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + (text.back() != '\n');
  });
  for (std::size_t i = 1; i < parts.size(); ++i) parts[i].row = parts[i - 1].row + parts[i - 1].rows;
  return parts;
}

void read_part(const TablePart& part, const SourceText& text, const TableHead& head, bool gaps,
               std::vector<std::vector<double>>& values) {
  const std::size_t columns = head.columns.size(), rows = values.front().size();
  const char* const end = text.bytes.data() + text.bytes.find_last_not_of("\r\n") + 1;
  const char* const part_end = part.text.data() + part.text.size();
  const char* next = part.text.data();
  for (std::size_t at = part.row; next < part_end; ++at) {
    if (at % kRowsBetweenQuestions == 0) expect_no_interruption();
    const char* const row = next;
    const auto refuse = [&] { fail_row(text, head, static_cast<std::size_t>(row - text.bytes.data()), gaps); };
    for (std::size_t column = 0; column < columns; ++column) {
      while (next < end && is_blank(*next)) ++next;
      if (end - next > 1 && *next == '+' && next[1] != '-') ++next;
      double value = 0.0;
      const auto [rest, error] = std::from_chars(next, end, value);
      const bool nan = gaps && column > 0 && std::isnan(value);  // as numpy and pandas write a gap
      if (error == std::errc{} && (std::isfinite(value) || nan)) {
        next = rest;
      } else if (error == std::errc::invalid_argument && gaps && column > 0 &&
                 (next == end || *next == ',' || *next == '\r' || *next == '\n') && next[-1] != '+') {
        value = std::numeric_limits<double>::quiet_NaN();
      } else {
        refuse();
      }
      while (next < end && is_blank(*next)) ++next;
      if (column + 1 < columns) {
        if (next == end || *next != ',') refuse();
        ++next;
      }
      if (at < rows) values[column][at] = value;
    }
    if (next < end && *next == '\r') ++next;
    if (next < end) {
      if (*next != '\n') refuse();
      ++next;
    }
  }
}

}  // namespace

CommentBlock comment_block(const SourceText& text) {
  CommentBlock block;
  while (block.end < text.bytes.size() && text.bytes[block.end] == '#') {
    const std::size_t next = line_at(text.bytes, block.end).next;
    block.toml += ' ';
    block.toml += text.bytes.substr(block.end + 1, next - block.end - 1);
    block.end = next;
    if (block.end > kLongestComments) fail_at(text, block.end, "expected at most 1 MiB of comment lines, found more.");
  }
  return block;
}

TableHead table_head(const SourceText& text, std::size_t offset) {
  if (offset >= text.bytes.size()) fail_at(text, offset, "expected a line of column names, found the end of the file.");
  const TextLine line = line_at(text.bytes, offset);
  TableHead head;
  head.body = line.next;
  for (const auto& [name, place] : cells_of(line)) {
    if (name.empty()) fail_at(text, place, "expected the name of a column, found nothing.");
    const auto refused = [](char c) {
      return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == ';' || c == 0x7F;
    };
    if (std::any_of(name.begin(), name.end(), refused)) {
      fail_at(text, place,
              fmt::format("expected column names without quotes, separated by commas, found {}.", in_quotes(name)));
    }
    if (head.columns.size() == kMostColumns) {
      fail_at(text, place, fmt::format("expected at most {} columns, found more.", kMostColumns));
    }
    head.columns.push_back({std::string(name), place});
  }
  std::vector<const ColumnName*> sorted;
  for (const ColumnName& column : head.columns) sorted.push_back(&column);
  std::stable_sort(sorted.begin(), sorted.end(), [](auto* left, auto* right) { return left->name < right->name; });
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end(),
                                        [](auto* left, auto* right) { return left->name == right->name; });
  if (twice != sorted.end()) {
    fail_at(text, twice[1]->offset,
            fmt::format("expected each column once, found {} again.", in_quotes(twice[1]->name)));
  }
  return head;
}

void expect_column(const SourceText& text, const TableHead& head, bool is_there, std::string_view name) {
  if (!is_there) fail_at(text, head.columns.front().offset, fmt::format("expected a column {}, found none.", name));
}

std::vector<std::vector<double>> table_columns(const SourceText& text, const TableHead& head, bool gaps) {
  // Line ends after the last row are no rows.
  const std::string_view bytes = text.bytes.substr(0, text.bytes.find_last_not_of("\r\n") + 1);
  if (bytes.size() <= head.body)
    fail_at(text, text.bytes.size(), "expected at least one row of numbers, found the end of the file.");
  const std::size_t columns = head.columns.size();
  const std::string_view body = bytes.substr(head.body);
  const std::vector<TablePart> parts = parts_of(body);
  const std::size_t lines = parts.back().row + parts.back().rows;
  std::vector<std::vector<double>> values(columns);
  // A row has at least a comma or a line end a column, so memory is bounded by the size of the file. Of more lines one
  // is no row, and is refused.
  const std::size_t rows = std::min(lines, body.size() / columns + 1);
  in_parallel(columns, [&](std::size_t column) { values[column].resize(rows); });
  in_parallel(parts.size(), [&](std::size_t i) { read_part(parts[i], text, head, gaps, values); });
  return values;
}

void fail_at_cell(const SourceText& text, const TableHead& head, std::size_t row, std::size_t column,
                  std::string_view expected) {
  std::size_t offset = head.body;
  for (std::size_t i = 0; i < row; ++i) offset = line_at(text.bytes, offset).next;
  const Cell cell = cells_of(line_at(text.bytes, offset)).at(column);
  fail_at(text, cell.offset, fmt::format("expected {}, found {}.", expected, in_quotes(cell.text)));
}

void expect_rising(const SourceText& text, const TableHead& head, std::size_t column, std::span<const double> time) {
  const auto falls =
      std::adjacent_find(time.begin(), time.end(), [](double left, double right) { return !(right > left); });
  if (falls == time.end()) return;
  fail_at_cell(text, head, static_cast<std::size_t>(falls - time.begin()) + 1, column,
               fmt::format("{} above {} of the row before", head.columns[column].name, *falls));
}

}  // namespace ballbar
