#include "text/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace ballbar {
namespace {

constexpr std::size_t kLongestComments = std::size_t{1} << 20;
constexpr std::size_t kMostColumns = 10000;

std::size_t line_end(std::string_view bytes, std::size_t offset) {
  return std::min(bytes.find('\n', offset), bytes.size());
}

// The line at `offset` without its line end.
std::string_view line_at(std::string_view bytes, std::size_t offset) {
  std::string_view line = bytes.substr(offset, line_end(bytes, offset) - offset);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::size_t next_line(std::string_view bytes, std::size_t offset) {
  return std::min(line_end(bytes, offset) + 1, bytes.size());
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view cell) {
  while (!cell.empty() && is_blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && is_blank(cell.back())) cell.remove_suffix(1);
  return cell;
}

// Why the row at `offset` is not `columns` numbers: said once, slowly.
[[noreturn]] void fail_row(const SourceText& text, const TableHead& head, std::size_t offset, bool gaps) {
  const std::string_view line = line_at(text.bytes, offset);
  const std::size_t columns = head.columns.size();
  if (trimmed(line).empty()) {
    fail_at(text, offset, fmt::format("expected a row of {} values, found an empty line.", columns));
  }
  if (line.find_first_of(";\t") != std::string_view::npos) {
    fail_at(text, offset + line.find_first_of(";\t"),
            fmt::format("expected values separated by commas, decimals with a point, found {}.", in_quotes(line)));
  }
  const std::size_t cells = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
  if (cells != columns) {
    fail_at(text, offset,
            fmt::format("expected {} values, one for each column, found {}{}.", columns, cells,
                        cells > columns ? "; decimals need a point, not a comma" : ""));
  }
  std::size_t begin = 0;
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view cell = trimmed(line.substr(begin, end - begin));
    const std::size_t place = offset + (cell.empty() ? begin : static_cast<std::size_t>(cell.data() - line.data()));
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
    begin = end + 1;
  }
  fail_at(text, offset, fmt::format("expected {} numbers separated by commas, found {}.", columns, in_quotes(line)));
}

}  // namespace

CommentBlock comment_block(const SourceText& text) {
  CommentBlock block;
  while (block.end < text.bytes.size() && text.bytes[block.end] == '#') {
    const std::size_t next = next_line(text.bytes, block.end);
    block.toml += ' ';
    block.toml += text.bytes.substr(block.end + 1, next - block.end - 1);
    block.end = next;
    if (block.end > kLongestComments) fail_at(text, block.end, "expected at most 1 MiB of comment lines, found more.");
  }
  return block;
}

TableHead table_head(const SourceText& text, std::size_t offset) {
  if (offset >= text.bytes.size()) fail_at(text, offset, "expected a line of column names, found the end of the file.");
  const std::string_view line = line_at(text.bytes, offset);
  TableHead head;
  head.body = next_line(text.bytes, offset);
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view name = trimmed(line.substr(begin, end - begin));
    const std::size_t place = offset + (name.empty() ? begin : static_cast<std::size_t>(name.data() - line.data()));
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
    begin = end + 1;
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

std::vector<std::vector<double>> table_columns(const SourceText& text, const TableHead& head, bool gaps) {
  // Line ends after the last row are no rows.
  const std::string_view bytes = text.bytes.substr(0, text.bytes.find_last_not_of("\r\n") + 1);
  if (bytes.size() <= head.body)
    fail_at(text, text.bytes.size(), "expected at least one row of numbers, found the end of the file.");
  const std::size_t columns = head.columns.size();
  const std::string_view body = bytes.substr(head.body);
  const auto lines = static_cast<std::size_t>(std::count(body.begin(), body.end(), '\n')) + 1;
  std::vector<std::vector<double>> values(columns);
  // A row has at least a comma or a line end a column, so memory is bounded by the size of the file.
  for (auto& column : values) column.reserve(std::min(lines, body.size() / columns + 1));

  const char* const end = body.data() + body.size();
  const char* next = body.data();
  while (next < end) {
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
      values[column].push_back(value);
    }
    if (next < end && *next == '\r') ++next;
    if (next < end) {
      if (*next != '\n') refuse();
      ++next;
    }
  }
  return values;
}

void fail_at_cell(const SourceText& text, const TableHead& head, std::size_t row, std::size_t column,
                  std::string_view expected) {
  std::size_t offset = head.body;
  for (std::size_t i = 0; i < row; ++i) offset = next_line(text.bytes, offset);
  const std::string_view line = line_at(text.bytes, offset);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < column; ++i) begin = line.find(',', begin) + 1;
  const std::string_view cell = trimmed(line.substr(begin, line.find(',', begin) - begin));
  fail_at(text, offset + static_cast<std::size_t>(cell.data() - line.data()),
          fmt::format("expected {}, found {}.", expected, in_quotes(cell)));
}

void expect_rising(const SourceText& text, const TableHead& head, std::size_t column, std::span<const double> time) {
  const auto falls =
      std::adjacent_find(time.begin(), time.end(), [](double left, double right) { return !(right > left); });
  if (falls == time.end()) return;
  fail_at_cell(text, head, static_cast<std::size_t>(falls - time.begin()) + 1, column,
               fmt::format("{} above {} of the row before", head.columns[column].name, *falls));
}

}  // namespace ballbar
