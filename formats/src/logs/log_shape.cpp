#include "logs/log_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/column_sample.hpp"
#include "logs/log_header.hpp"
#include "logs/log_sources.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kHead = std::size_t{1} << 20;
constexpr std::size_t kMostHeadLines = 3000;
constexpr char kDelimiters[] = {'\t', ';', ',', '|', ' '};

using Cells = std::vector<std::string_view>;

// "0,5,23,4": the cells are cut at their decimal commas.
void expect_no_decimal_delimiter(const std::string& name, const LogShape& shape, const std::vector<HeadLine>& lines,
                                 const Cut& cut) {
  if (shape.delimiter != ',') return;
  Cells cells;
  std::size_t line = cut.first;  // of the names: the last above that is not blank
  while (line > 0 && is_blank(lines[line - 1].text)) --line;
  if (line == 0) return;
  split_cells(lines[line - 1].text, ',', cells);
  const std::size_t headers = cells.size(), header_line = lines[line - 1].number;
  const auto is_text = [](std::string_view cell) { return kind_of(cell) == CellKind::word; };
  if (headers < 2 || 2 * std::count_if(cells.begin(), cells.end(), is_text) < static_cast<std::ptrdiff_t>(headers))
    return;
  split_cells(lines[cut.first].text, ',', cells);
  if (cells.size() < headers + 2 || lines[cut.first].text.find('.') != std::string::npos) return;
  throw Error(
      fmt::format("{}:{}: expected {} values, one for each name of line {}, found {}. Separators and decimal commas "
                  "are ambiguous. Export with semicolons or tabs between the values, or with decimal points.",
                  name, lines[cut.first].number, headers, header_line, cells.size()));
}

std::vector<HeadLine> head_lines(const Source& source, const TextEncoding& encoding) {
  std::vector<HeadLine> lines;
  LogLines text(source, encoding);
  std::size_t bytes = 0;
  while (lines.size() < kMostHeadLines && bytes < kHead && text.next(true)) {
    lines.push_back({std::string(text.line()), text.number()});
    bytes += text.line().size() + 1;
  }
  return lines;
}

// From the line of the names on, where a user states it.
void expect_header_line(std::vector<HeadLine>& lines, const std::string& name, const LogRecipe& recipe) {
  if (recipe.header_line == 0) return;
  const auto header =
      std::find_if(lines.begin(), lines.end(), [&](const HeadLine& line) { return line.number == recipe.header_line; });
  if (header == lines.end() || is_blank(header->text)) {
    throw Error(fmt::format("{}:{}: expected the names of the columns, as --header-line states, found no text.", name,
                            recipe.header_line));
  }
  lines.erase(lines.begin(), header);
}

Cut best_cut(const std::vector<HeadLine>& lines, const LogRecipe& recipe) {
  Cut best;
  for (const char delimiter : kDelimiters) {
    if (recipe.delimiter && delimiter != *recipe.delimiter) continue;
    // One column alone is a table only where a user says how its rows run.
    const Cut cut = cut_by(lines, delimiter, recipe.every_s || recipe.time == "none" ? 1 : 2);
    // Blanks stand between words too: another sign goes first.
    if (cut.score > best.score * (delimiter == ' ' ? 1.1 : 1.02) + 1e-9) best = cut;
  }
  return best;
}
}  // namespace

bool holds_table(std::string_view head) {
  const TextEncoding encoding = encoding_of(head);
  if (head.empty() || encoding.name.empty()) return false;
  return best_cut(head_lines(Source::of_text({}, std::string(head)), encoding), {}).score > 0.0;
}

LogShape log_shape(const Source& source, const LogRecipe& recipe) {
  LogShape shape;
  const std::string& name = source.name();
  const std::string head = source.head(kHeadBytes);
  if (head.empty()) throw Error(fmt::format("{}:1: expected a table of numbers over time, found an empty file.", name));
  shape.encoding = encoding_of(head);
  if (shape.encoding.name.empty()) {
    throw Error(
        fmt::format("{}:1: expected text, a workbook (.xlsx) or a .mat file, found another binary file.", name));
  }
  std::vector<HeadLine> lines = head_lines(source, shape.encoding);
  expect_header_line(lines, name, recipe);
  Cut best = best_cut(lines, recipe);
  if (recipe.header_line > 0 && best.first == 0) best.first = 1;  // names that are numbers
  if (best.score == 0.0) {
    throw Error(fmt::format(
        "{}:1: expected rows of at least two values separated by commas, semicolons, tabs or blanks, found none in the "
        "first {} lines.",
        name, lines.size()));
  }
  if (best.columns > kMostColumns) {
    throw Error(fmt::format("{}:{}: expected at most {} columns, found {}.", name, lines[best.first].number,
                            kMostColumns, best.columns));
  }
  shape.delimiter = best.delimiter;
  shape.first_row_line = lines[best.first].number;
  expect_no_decimal_delimiter(name, shape, lines, best);
  std::size_t row_bytes = 0;
  for (std::size_t i = best.first; i < lines.size(); ++i) {
    row_bytes += lines[i].text.size() + 1;
    if (!is_blank(lines[i].text)) shape.rows.push_back(lines[i]);
  }
  shape.headers.resize(best.columns);
  const auto above = std::span(lines).first(best.first);
  find_decimal(name, above.last(std::min<std::size_t>(2, above.size())), recipe, shape);
  find_names(name, lines, best, recipe.header_line > 0, shape);
  shape.bytes_a_row = std::max<std::size_t>(2, row_bytes / std::max<std::size_t>(1, shape.rows.size()));
  shape.day_first = shape.decimal == ',' || shape.delimiter == ';';
  return shape;
}

}  // namespace ballbar
