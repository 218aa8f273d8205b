#include "logs/log_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "logs/time_stamp.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostHeaderRows = 30;  // above the first row
constexpr std::size_t kMostNameRows = 9;
constexpr std::size_t kLinesOfAWord = 3;    // that have it in one place: it is a word of a column
constexpr std::size_t kFewestNumbered = 4;  // columns
constexpr double kRepeated = -3.0;          // log likelihood of a name that another column has
constexpr double kKindOfValue = -4.0;       // of a name such as "Avg", "Smp", "float"
constexpr double kFurtherUp = -0.5;         // a row
constexpr double kOfOtherSize = -2.0;       // a cell too many or too few
constexpr double kCommentSign = -6.0;       // a name row in plain text goes before one in a comment

using Cells = std::vector<std::string_view>;
using Kinds = std::array<double, kCellKinds>;

// Log likelihoods of what a cell is, by what its row is:
//
//                               empty  missing  number   stamp    word
//   of names                     0.05     0.04    0.02   0.005    0.885
//   of anything else above       0.30     0.05    0.25    0.10    0.30
//   data in a column of values   at least 0.2 a gap, 0.01 a word, 0.005 a number, 0.002 a stamp; else as in the rows
//   data in a column of words    at least 0.3 a word, 0.05 a gap, 0.01 a value; else as in the rows
constexpr Kinds kOfNames = {0.05, 0.04, 0.02, 0.005, 0.885};
constexpr Kinds kOfOthers = {0.30, 0.05, 0.25, 0.10, 0.30};
constexpr Kinds kLeastOfValues = {0.20, 0.20, 0.005, 0.002, 0.01};
constexpr Kinds kLeastOfWords = {0.05, 0.05, 0.01, 0.01, 0.30};

double at(const Kinds& likelihood, CellKind kind) { return likelihood[static_cast<std::size_t>(kind)]; }

// Of each column the likelihood of its cells, counted in the rows.
std::vector<Kinds> likelihood_of_data(const std::vector<LineKinds>& lines, const Cut& cut, std::size_t fewest) {
  std::vector<Kinds> columns(cut.columns, Kinds{});
  double rows = 0.0;
  for (const LineKinds& line : lines) {
    if (line.kinds.size() != cut.columns || !line.is_row(fewest)) continue;
    ++rows;
    for (std::size_t j = 0; j < cut.columns; ++j) ++columns[j][static_cast<std::size_t>(line.kinds[j])];
  }
  for (Kinds& column : columns) {
    const double values = at(column, CellKind::number) + at(column, CellKind::stamp);
    const Kinds& least = values > 0.0 ? kLeastOfValues : kLeastOfWords;
    for (std::size_t k = 0; k < kCellKinds; ++k) column[k] = std::max(least[k], column[k] / rows);
  }
  return columns;
}

// How much more likely a line is one of data than one of names or anything else. A word behind the last column is a
// remark.
double evidence_of_data(const LineKinds& line, const std::vector<Kinds>& columns) {
  double data = 0.0, names = 0.0, others = 0.0;
  for (std::size_t j = 0; j < line.kinds.size(); ++j) {
    data += std::log(at(j < columns.size() ? columns[j] : kLeastOfWords, line.kinds[j]));
    names += std::log(at(kOfNames, line.kinds[j]));
    others += std::log(at(kOfOthers, line.kinds[j]));
  }
  return data - std::max(names, others);
}

std::vector<LineKinds> kinds_of(const std::vector<HeadLine>& lines, char delimiter) {
  std::vector<LineKinds> all(lines.size());
  std::map<std::tuple<std::size_t, std::size_t, std::string_view>, std::size_t>
      words;  // by cells of the line and place
  Cells cells;
  const auto each_word = [&](auto use) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (all[i].kinds.empty()) continue;
      split_cells(lines[i].text, delimiter, cells);
      for (std::size_t j = 0; j < cells.size(); ++j) {
        if (all[i].kinds[j] == CellKind::word) use(all[i], words[{cells.size(), j, trimmed_cell(cells[j])}]);
      }
    }
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_blank(lines[i].text) || lines[i].text.starts_with('#')) continue;
    split_cells(lines[i].text, delimiter, cells);
    for (const std::string_view cell : cells) all[i].kinds.push_back(kind_of(cell));
  }
  each_word([](LineKinds&, std::size_t& count) { ++count; });
  each_word([](LineKinds& line, const std::size_t& count) { line.own_words += count < kLinesOfAWord; });
  return all;
}

bool is_empty_unit(std::string_view text) {
  return text.empty() || text == "-" || text == "[-]" || text == "()" || text == "[]";
}

// "Bearing [°C]": a name of its own, which the row of names completes.
bool is_name_with_unit(std::string_view text) {
  const NameAndUnit both = name_and_unit(text);
  return !both.name.empty() && log_unit(both.unit);
}

// A row in which what is written are units, some perhaps behind names; words that are names of columns as well do not
// make it one.
bool is_units_row(const Cells& cells) {
  constexpr std::string_view kOthers =
      "ts|rn|hz|khz|mhz|deg|degrees|kg|g|kn|n|knm|digits|counts|samples|unitless|mv v|ustrain|microstrain|strain|w m 2|"
      "m s|m s 2|meters second|kohm|ohm|ohms|hh mm ss|dd mm yyyy|yyyy mm dd|hh mm ss fff|tt mm jjjj";
  constexpr std::string_view kNamesToo = "no|nr|date|time|datum|zeit|unit|units|einheit|date time|sample";
  std::size_t written = 0, units = 0, known = 0;
  for (const std::string_view cell : cells) {
    const std::string_view text = trimmed_cell(cell);
    if (is_empty_unit(text)) continue;
    ++written;
    const std::string key = folded(text);
    const bool is_known = log_unit(text) || is_one_of(kOthers, key);
    known += is_known;
    units += is_known || is_name_with_unit(text) || time_unit_s(text) || is_one_of(kNamesToo, key);
  }
  return known > 0 && units * 10 >= written * 6;
}

bool is_kind_of_value(const std::string& folded_name) {
  constexpr std::string_view kKinds =
      "smp|avg|max|min|std|tot|med|average|mean|sample|float|double|int|integer|real|bool|string|ieee4|fp2|number|"
      "text|date|wvc|sum";
  return is_one_of(kKinds, folded_name);
}

// "***" or "---": a message of the logger, or a line without a meaning.
bool has_signs_alone(const Cells& cells) {
  return std::any_of(cells.begin(), cells.end(), [](std::string_view cell) {
    return trimmed_cell(cell).size() > 2 && kind_of(cell) != CellKind::number && folded(trimmed_cell(cell)).empty();
  });
}

// How much more likely a row is one of names than any other; nullopt: it cannot be.
std::optional<double> evidence_of_names(const Cells& cells, std::size_t columns) {
  std::set<std::string> names;
  std::size_t words = 0, values = 0;
  double sum = kOfOtherSize * std::abs(static_cast<double>(cells.size()) - static_cast<double>(columns));
  for (const std::string_view cell : cells) {
    CellKind kind = kind_of(cell);
    if (kind == CellKind::missing && trimmed_cell(cell).size() > 1) kind = CellKind::word;  // "Open", "Error"
    words += kind == CellKind::word;
    values += kind == CellKind::number || kind == CellKind::stamp;
    sum += std::log(at(kOfNames, kind) / at(kOfOthers, kind));
    if (kind != CellKind::word) continue;
    const std::string name = folded(trimmed_cell(cell));
    if (is_kind_of_value(name)) sum += kKindOfValue;
    if (!names.insert(name).second) sum += kRepeated;
  }
  return words > 0 && words >= values ? std::optional(sum) : std::nullopt;
}

// 0, 1, 2 ... or 1, 2, 3 ... in all columns, as programs write that have no names.
bool numbers_the_columns(std::string_view line, char delimiter) {
  Cells cells;
  split_cells(line, delimiter, cells);
  for (const std::size_t first : {0u, 1u}) {
    std::size_t j = 0;
    while (j < cells.size() && trimmed_cell(cells[j]) == std::to_string(first + j)) ++j;
    if (j == cells.size() && j >= kFewestNumbered) return true;
  }
  return false;
}

std::string without_comment_sign(std::string_view line) {
  const std::size_t first = line.find_first_not_of("#%!/ \t");
  const bool is_comment = line.starts_with("//") || line.find_first_of("#%!") == 0;
  return std::string(is_comment && first != std::string_view::npos ? line.substr(first) : line);
}

// Names may hold single blanks where columns are parted by several, or where each ends in a bracket: "Time [s] Bearing
// temp [C]".
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
  wide.clear();
  for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end) {
    end = std::min(line.find_first_of("])", begin), line.size() - 1) + 1;
    wide.push_back(trimmed_cell(line.substr(begin, end - begin)));
  }
  if (wide.size() == cut.columns && !line.empty() && cells.size() != cut.columns) cells = wide;
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

// "23.4 °C", "bearing=23.4"
bool is_number_with_words(std::string_view cell) {
  cell.remove_prefix(cell.find('=') + 1);  // none: 0
  const std::size_t last = cell.find_last_of("0123456789");
  if (last == std::string_view::npos) return false;
  const std::string_view unit = cell.substr(last + 1);
  return look_of(cell.substr(0, last + 1)).kind != NumberLook::Kind::other && (unit.empty() || log_unit(unit));
}

}  // namespace

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t,;|\"") == std::string_view::npos; }

CellKind kind_of(std::string_view cell) {
  cell = trimmed_cell(cell);
  if (cell.empty()) return CellKind::empty;
  if (look_of(cell).kind != NumberLook::Kind::other || is_number_with_words(cell)) return CellKind::number;
  if (time_stamp(cell, DateOrder::day_first) || clock_of_dots(cell)) return CellKind::stamp;
  return is_missing(cell) || switch_value(cell) ? CellKind::missing : CellKind::word;
}

std::string written(std::string_view cell) {
  std::string valid;
  for (cell = trimmed_cell(cell); !cell.empty();) {
    const std::size_t length = utf8_length(cell);
    if (static_cast<unsigned char>(cell.front()) >= 0x20) valid += cell.substr(0, length);
    cell.remove_prefix(std::max<std::size_t>(1, length));
  }
  return valid;
}

std::size_t LineKinds::count(CellKind kind) const {
  return static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), kind));
}

bool LineKinds::is_row(std::size_t fewest) const {
  const std::size_t gaps = count(CellKind::empty) + count(CellKind::missing), found = values();
  return kinds.size() >= fewest && found > 0 && found + gaps >= 2 * own_words && found >= own_words &&
         2 * (found + gaps) >= count(CellKind::word);
}

Cut cut_by(const std::vector<HeadLine>& lines, char delimiter, std::size_t fewest) {
  const std::vector<LineKinds> looks = kinds_of(lines, delimiter);
  std::map<std::size_t, double> weights;  // of a number of cells: by the share of values
  for (const LineKinds& line : looks) {
    if (!line.is_row(fewest)) continue;
    weights[line.kinds.size()] +=
        static_cast<double>(line.kinds.size() - line.own_words) / static_cast<double>(line.kinds.size());
  }
  Cut cut;
  cut.delimiter = delimiter;
  for (const auto& [columns, weight] : weights) {
    if (weight > cut.score) cut = {delimiter, columns, 0, weight};
  }
  if (cut.score == 0.0) return cut;
  // A line of the preamble that happens to hold a number has fewer than a row.
  std::vector<std::size_t> values;
  for (const LineKinds& line : looks) {
    if (line.is_row(fewest) && line.kinds.size() == cut.columns) values.push_back(line.values());
  }
  const std::size_t usual = median(std::move(values));
  const std::vector<Kinds> columns = likelihood_of_data(looks, cut, fewest);
  std::size_t least_cells = cut.columns;  // behind the last value a row may end
  while (least_cells > 1 && at(columns[least_cells - 1], CellKind::number) <= kLeastOfWords[2] &&
         at(columns[least_cells - 1], CellKind::stamp) <= kLeastOfWords[3])
    --least_cells;
  const auto suits = [&](const LineKinds& line) {
    return line.kinds.size() >= least_cells && 3 * line.values() >= usual && line.values() > 0 &&
           evidence_of_data(line, columns) > 0.0;
  };
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (!suits(looks[i])) continue;
    std::size_t rows = 0, good = 0;  // a row among lines of text is one of the preamble
    bool names_follow = false;       // as they do below the ratios of channels
    for (std::size_t k = i + 1; k < looks.size() && rows < 4; ++k) {
      if (looks[k].kinds.empty()) continue;
      names_follow = names_follow || (rows == 0 && cut.columns > 1 && looks[k].kinds.size() == cut.columns &&
                                      looks[k].count(CellKind::word) == cut.columns);
      ++rows;
      good += suits(looks[k]);
    }
    if (names_follow) continue;
    const bool is_short = looks[i].kinds.size() < cut.columns;  // as most lines of a preamble are
    if (good + (is_short ? 0 : 1) < rows || (rows > 0 && numbers_the_columns(lines[i].text, delimiter))) continue;
    cut.first = i;
    return cut;
  }
  cut.score = 0.0;
  return cut;
}

void find_header(const std::vector<HeadLine>& lines, const Cut& cut, bool is_first, LogShape& shape) {
  Cells cells;
  struct Row {
    std::size_t index;
    double evidence;
  };
  std::vector<Row> names;
  std::optional<std::size_t> units;
  bool units_have_names = false;
  const auto split = [&](std::size_t index, std::string& text) {
    text = without_comment_sign(lines[index].text);
    split_header(text, cut, cells);
  };
  std::string text;
  std::size_t rows = 0;
  for (std::size_t i = cut.first; i-- > 0 && rows < kMostHeaderRows && names.size() < kMostNameRows;) {
    if (is_blank(lines[i].text)) continue;
    ++rows;
    if (lines[i].text.starts_with("***")) break;  // the end of a part of LabVIEW's measurement files
    split(i, text);
    if (cells.size() + 1 < cut.columns || (cells.size() < 2 && cut.columns > 1) || cells.size() > 2 * cut.columns) {
      // Above a header in another shape begins the preamble; a name row may follow a line of text within two lines.
      if (!names.empty() || units || rows > 2) break;
      continue;
    }
    if (has_signs_alone(cells)) continue;
    if (!units && is_units_row(cells)) {
      units = i;
      units_have_names = std::any_of(cells.begin(), cells.end(),
                                     [](std::string_view cell) { return is_name_with_unit(trimmed_cell(cell)); });
    } else if (units_have_names &&
               (cells.size() != cut.columns || std::any_of(cells.begin(), cells.end(), [](std::string_view cell) {
                  return kind_of(cell) != CellKind::word || is_name_with_unit(trimmed_cell(cell));
                }))) {
      break;  // such a row is one of names itself, unless words stand above each
    } else if (const auto evidence = evidence_of_names(cells, cut.columns)) {
      const bool is_comment = lines[i].text.starts_with('#');
      names.push_back({i, *evidence + kFurtherUp * static_cast<double>(rows) + (is_comment ? kCommentSign : 0.0)});
    } else {
      break;
    }
    if (units && !names.empty() && names.back().index < *units && names.back().evidence > 0.0) break;
  }
  // Names stand above their units, where any do.
  if (units && std::any_of(names.begin(), names.end(), [&](const Row& row) { return row.index < *units; }))
    std::erase_if(names, [&](const Row& row) { return row.index > *units; });
  std::optional<std::size_t> name;
  if (!names.empty()) {
    name = std::max_element(names.begin(), names.end(), [](const Row& a, const Row& b) {
             return a.evidence < b.evidence;
           })->index;
  } else if (units) {  // one line of names that could be units: "t,A"
    name = units;
    split(*units, text);
    const bool all = std::all_of(cells.begin(), cells.end(), [](std::string_view cell) {
      return log_unit(trimmed_cell(cell)) || time_unit_s(trimmed_cell(cell));
    });
    if (!all) units.reset();
  }
  if (is_first) {
    name = 0;
    if (units == name) units.reset();
  }
  const auto take = [&](const std::optional<std::size_t>& index, std::vector<std::string>& to, std::size_t& line) {
    to.assign(cut.columns, "");
    if (!index) return;
    split(*index, text);
    if (cells.size() + 1 == cut.columns && lacks_first_name(cells, lines, cut))
      cells.insert(cells.begin(), std::string_view());
    for (std::size_t i = 0; i < std::min(cut.columns, cells.size()); ++i) to[i] = written(cells[i]);
    line = lines[*index].number;
  };
  take(name, shape.headers, shape.header_line);
  take(units, shape.units, shape.units_line);
  for (std::size_t i = 0; i < cut.columns; ++i) {
    if (units == name || !is_name_with_unit(shape.units[i])) continue;
    shape.headers[i] += " " + std::exchange(shape.units[i], "");
  }
  const std::size_t top = std::min({cut.first, name.value_or(cut.first), units.value_or(cut.first)});
  shape.preamble.assign(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(top));
}

}  // namespace ballbar
