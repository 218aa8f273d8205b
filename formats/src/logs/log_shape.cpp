#include "logs/log_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "ballbar/numerics/order_statistic.hpp"
#include "logs/column_sample.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_sources.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "logs/time_stamp.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kHead = std::size_t{1} << 20;
constexpr std::size_t kMostHeadLines = 3000;
constexpr std::size_t kMostHeaderRows = 30;
constexpr char kDelimiters[] = {'\t', ';', ',', '|', ' '};

using Cells = std::vector<std::string_view>;

enum class CellKind { empty, missing, number, stamp, text };

CellKind kind_of(std::string_view cell) {
  cell = trimmed_cell(cell);
  if (cell.empty()) return CellKind::empty;
  if (look_of(cell).kind != NumberLook::Kind::other) return CellKind::number;
  if (time_stamp(cell, DateOrder::day_first)) return CellKind::stamp;
  return is_missing(cell) || switch_value(cell) ? CellKind::missing : CellKind::text;
}

// What the cells of a line are.
struct LineLook {
  std::size_t cells = 0, values = 0, missing = 0, texts = 0;

  // Mostly numbers and times; a line of nothing but gaps is none.
  [[nodiscard]] bool is_row(std::size_t fewest) const {
    return cells >= fewest && values > 0 && values + missing >= 2 * texts && values >= texts;
  }
};

LineLook look_at(std::string_view line, char delimiter, Cells& cells) {
  split_cells(line, delimiter, cells);
  LineLook look;
  look.cells = cells.size();
  for (const std::string_view cell : cells) {
    const CellKind kind = kind_of(cell);
    look.values += kind == CellKind::number || kind == CellKind::stamp;
    look.missing += kind == CellKind::missing || kind == CellKind::empty;
    look.texts += kind == CellKind::text;
  }
  return look;
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t,;|\"") == std::string_view::npos; }

struct Cut {
  char delimiter = ',';
  std::size_t columns = 0;
  std::size_t first = 0;  // index of the first row
  double score = 0.0;
};

// The rows of one delimiter: lines of the same number of cells, mostly values, that follow each other.
Cut cut_by(const std::vector<HeadLine>& lines, char delimiter, std::size_t fewest) {
  Cells cells;
  std::vector<LineLook> looks;
  looks.reserve(lines.size());
  std::map<std::size_t, double> weights;  // of a number of cells: by the share of values
  for (const HeadLine& line : lines) {
    looks.push_back(is_blank(line.text) || line.text.starts_with('#') ? LineLook{}
                                                                      : look_at(line.text, delimiter, cells));
    const LineLook& look = looks.back();
    if (look.is_row(fewest)) {
      weights[look.cells] += static_cast<double>(look.values + look.missing) / static_cast<double>(look.cells);
    }
  }
  Cut cut;
  cut.delimiter = delimiter;
  for (const auto& [columns, weight] : weights) {
    if (weight > cut.score) cut = {delimiter, columns, 0, weight};
  }
  // A line of the preamble that happens to hold a number has fewer than a row.
  std::vector<std::size_t> values;
  for (const LineLook& look : looks) {
    if (look.is_row(fewest) && look.cells == cut.columns) values.push_back(look.values);
  }
  const std::size_t usual = values.empty() ? 0 : median(std::move(values));
  const auto suits = [&](const LineLook& look) {
    if (3 * look.values < usual) return false;
    return look.is_row(fewest) && look.cells == cut.columns;
  };
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (!suits(looks[i])) continue;
    std::size_t rows = 0, good = 0;  // a row among lines of text is one of the preamble
    for (std::size_t k = i + 1; k < looks.size() && rows < 4; ++k) {
      if (looks[k].cells == 0) continue;
      ++rows;
      good += suits(looks[k]);
    }
    if (good + 1 < rows) continue;
    cut.first = i;
    return cut;
  }
  cut.score = 0.0;
  return cut;
}

bool is_unit_like(std::string_view cell) {
  const std::string key = folded(trimmed_cell(cell));
  constexpr std::string_view kOthers[] = {
      "no",         "nr",   "date",  "time",    "datum",     "zeit",         "hh mm ss",  "dd mm yyyy",
      "yyyy mm dd", "unit", "units", "einheit", "date time", "sample",       "hz",        "n",
      "deg",        "kg",   "g",     "khz",     "samples",   "hh mm ss fff", "tt mm jjjj"};
  return log_unit(trimmed_cell(cell)) || time_unit_s(trimmed_cell(cell)) ||
         std::find(std::begin(kOthers), std::end(kOthers), key) != std::end(kOthers);
}

// A row in which what is written are units, at least one of them of the list.
bool is_units_row(const Cells& cells) {
  std::size_t written = 0, units = 0, known = 0;
  for (const std::string_view cell : cells) {
    const std::string_view text = trimmed_cell(cell);
    if (text.empty() || text == "-" || text == "[-]" || text == "()" || text == "[]") continue;
    ++written;
    units += is_unit_like(text);
    known += log_unit(text).has_value();
  }
  return known > 0 && units * 10 >= written * 7;
}

// A row of names: at least half is written, and is text.
bool is_names_row(const Cells& cells) {
  std::size_t texts = 0, others = 0;
  for (const std::string_view cell : cells) {
    const CellKind kind = kind_of(cell);
    texts += kind == CellKind::text || (kind == CellKind::missing && trimmed_cell(cell).size() > 1);
    others += kind == CellKind::number || kind == CellKind::stamp;
  }
  return texts > 0 && texts >= others;
}

std::string without_comment_sign(std::string_view line) {
  const std::size_t first = line.find_first_not_of("#%! \t");
  if (first == std::string_view::npos || line.find_first_of("#%!") != 0) return std::string(line);
  return std::string(line.substr(first));
}

// Names may hold single blanks where columns are parted by several.
void split_header(std::string_view line, const Cut& cut, Cells& cells) {
  split_cells(line, cut.delimiter, cells);
  if (cut.delimiter != ' ' || cells.size() == cut.columns) return;
  Cells wide;
  std::size_t at = line.find_first_not_of(" \t");
  while (at < line.size()) {
    const std::size_t end = std::min({line.find("  ", at), line.find('\t', at), line.size()});
    wide.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(" \t", end);
  }
  if (wide.size() == cut.columns) cells = wide;
}

// Names go into files of ours: what is no character is left out.
std::string valid_utf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (static_cast<unsigned char>(text.front()) >= 0x20) valid += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return valid;
}

void copy_cells(const Cells& cells, std::size_t columns, std::vector<std::string>& to) {
  to.assign(columns, "");
  for (std::size_t i = 0; i < std::min(columns, cells.size()); ++i) to[i] = valid_utf8(trimmed_cell(cells[i]));
}

// Whether these names are one fewer than the columns because the first column, of row names in quotes or of rows
// counted from 1, has none: as R writes tables.
bool lacks_first_name(const Cells& names, const std::vector<HeadLine>& lines, const Cut& cut) {
  const bool has_time =
      std::any_of(names.begin(), names.end(), [](std::string_view name) { return is_time_name(trimmed_cell(name)); });
  Cells cells;
  std::size_t rows = 0;
  for (std::size_t i = cut.first; i < lines.size(); ++i) {
    split_cells(lines[i].text, cut.delimiter, cells);
    if (cells.size() != cut.columns) continue;
    ++rows;
    const bool is_quoted = cells.front().find('"') != std::string_view::npos;
    const bool counts = !has_time && cell_number(trimmed_cell(cells.front()), '.') == static_cast<double>(rows);
    if (!(is_quoted || counts) || trimmed_cell(cells.back()).empty()) return false;
  }
  return rows > 1;
}

// Names and units from the lines directly above the rows.
void find_headers(const std::vector<HeadLine>& lines, const Cut& cut, LogShape& shape) {
  Cells cells;
  std::size_t lowest = cut.first;  // index of the upper of the two
  std::vector<std::size_t> names;
  std::size_t units = lines.size();
  std::size_t rows = 0;
  for (std::size_t i = cut.first; i-- > 0 && rows < kMostHeaderRows;) {
    if (is_blank(lines[i].text)) continue;
    ++rows;
    if (lines[i].text.starts_with("***")) break;  // the end of a part of LabVIEW's measurement files
    std::string text = without_comment_sign(lines[i].text);
    split_header(text, cut, cells);
    if (cells.size() + 1 < cut.columns || (cells.size() < 2 && cut.columns > 1) || cells.size() > cut.columns + 1) {
      // Above a header in another shape begins the preamble; a name row may follow a line of text within two lines.
      if (!names.empty() || units != lines.size() || rows > 2) break;
      continue;
    }
    if (units == lines.size() && is_units_row(cells)) {
      units = i;
    } else if (is_names_row(cells)) {
      names.push_back(i);
    } else {
      break;
    }
    if (!names.empty() && units != lines.size() && names.back() < units) break;
    if (names.size() > 8) break;
  }
  if (names.empty() && units != lines.size()) {  // one line of names that could be units: "t,A"
    names.push_back(units);
    const std::string text = without_comment_sign(lines[units].text);
    split_header(text, cut, cells);
    const bool all = std::all_of(cells.begin(), cells.end(), [](std::string_view cell) {
      return log_unit(trimmed_cell(cell)) || time_unit_s(trimmed_cell(cell));
    });
    if (!all) units = lines.size();
  }
  std::size_t name = lines.size();
  if (!names.empty()) {
    name = names.front();
    const auto above = std::find_if(names.begin(), names.end(), [&](std::size_t i) { return i < units; });
    const auto plain =
        std::find_if(names.begin(), names.end(), [&](std::size_t i) { return !lines[i].text.starts_with('#'); });
    if (plain != names.end()) name = *plain;
    if (units != lines.size() && above != names.end()) name = *above;
  }
  const auto take = [&](std::size_t index, std::vector<std::string>& to, std::size_t& line) {
    if (index == lines.size()) return;
    const std::string text = without_comment_sign(lines[index].text);
    split_header(text, cut, cells);
    if (cells.size() + 1 == cut.columns && lacks_first_name(cells, lines, cut))
      cells.insert(cells.begin(), std::string_view());
    copy_cells(cells, cut.columns, to);
    line = lines[index].number;
    lowest = std::min(lowest, index);
  };
  shape.headers.assign(cut.columns, "");
  shape.units.assign(cut.columns, "");
  take(name, shape.headers, shape.header_line);
  take(units, shape.units, shape.units_line);
  for (std::size_t i = 0; i < lowest; ++i) shape.preamble.push_back(lines[i]);
}

// "0,5,23,4": the cells are cut at their decimal commas.
void expect_no_decimal_delimiter(const std::string& name, const LogShape& shape, const std::vector<HeadLine>& lines,
                                 const Cut& cut) {
  if (shape.delimiter != ',') return;
  Cells cells;
  std::size_t line = cut.first;  // of the names: the last above that is not blank
  while (line > 0 && is_blank(lines[line - 1].text)) --line;
  if (line == 0) return;
  split_cells(lines[line - 1].text, ',', cells);
  const std::size_t headers = is_names_row(cells) && cells.size() > 1 ? cells.size() : 0;
  const std::size_t header_line = lines[line - 1].number;
  split_cells(lines[cut.first].text, ',', cells);
  if (headers == 0 || cells.size() < headers + 2) return;
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
  const std::vector<HeadLine> lines = head_lines(source, shape.encoding);
  const Cut best = best_cut(lines, recipe);
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
  find_headers(lines, best, shape);
  expect_no_decimal_delimiter(name, shape, lines, best);
  std::size_t row_bytes = 0;
  for (std::size_t i = best.first; i < lines.size(); ++i) {
    row_bytes += lines[i].text.size() + 1;
    if (!is_blank(lines[i].text)) shape.rows.push_back(lines[i]);
  }
  shape.bytes_a_row = std::max<std::size_t>(2, row_bytes / std::max<std::size_t>(1, shape.rows.size()));
  find_decimal(name, recipe, shape);
  shape.day_first = shape.decimal == ',' || shape.delimiter == ';';
  return shape;
}

}  // namespace ballbar
