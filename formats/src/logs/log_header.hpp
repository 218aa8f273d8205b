// What the rows of a log are, by evidence: which hold data, and where their names and units stand.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "logs/log_shape.hpp"

namespace ballbar {

// What a cell can be before anything is known of its column; `word`: text.
enum class CellKind : char { empty, missing, number, stamp, word };
inline constexpr std::size_t kCellKinds = 5;

CellKind kind_of(std::string_view cell);

// The kinds of all cells of a line; none of a blank line or a comment.
struct LineKinds {
  std::vector<CellKind> kinds;
  std::size_t own_words = 0;  // that other lines do not have in this place: no name of a channel, no unit, no state

  [[nodiscard]] std::size_t count(CellKind kind) const;
  [[nodiscard]] std::size_t values() const { return count(CellKind::number) + count(CellKind::stamp); }

  // Mostly numbers and times; a line of nothing but gaps is none.
  [[nodiscard]] bool is_row(std::size_t fewest) const;
};

// The rows of a delimiter.
struct Cut {
  char delimiter = ',';
  std::size_t columns = 0;
  std::size_t first = 0;  // index of the first row
  double score = 0.0;
};

// The rows of one delimiter: lines of the same number of cells, mostly values, that follow each other.
Cut cut_by(const std::vector<HeadLine>& lines, char delimiter, std::size_t fewest);

// Sets headers, units, header_line, units_line and preamble of the shape from the lines above the first row. is_first:
// a user states that the first line holds the names.
void find_header(const std::vector<HeadLine>& lines, const Cut& cut, bool is_first, LogShape& shape);

bool is_blank(std::string_view line);

inline constexpr double kExplained = 0.95;  // of the rows: what a layout must explain

// The layouts of a table, each a recogniser of the same rows:
//
//   values beside their names   "T1 20.1 T2 22.3"; the names are the same in all rows
//   points                      "group, name, 1, x, y, z" without names above: X, Y, Z
//   table                       all others, with the names above the rows or none
//
// Rows of channels below each other are a table as well until their times are known (log_channels.hpp). Sets names,
// units and preamble of the shape, whose rows are known. Throws Error with name:line where two layouts fit.
void find_names(const std::string& name, const std::vector<HeadLine>& lines, const Cut& cut, bool is_first,
                LogShape& shape);

// As a name or a unit goes into files of ours: without blanks and quotes around it, and what is no character.
std::string written(std::string_view cell);

}  // namespace ballbar
