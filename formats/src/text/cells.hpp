// Lines of delimited text and their cells.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

struct TextLine {
  std::string_view text;             // without its line end
  std::size_t offset = 0, next = 0;  // in the bytes; of the line after it
};
TextLine line_at(std::string_view bytes, std::size_t offset);

// Without such signs at both ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t");

// The quote that closes the one at `open`, "" being a quote within; npos where none does.
std::size_t closing_quote(std::string_view line, std::size_t open);

// Where the cell at `begin` ends: at the next delimiter or with the line. A delimiter in a cell within quotes is none;
// a cell that a quote opens and none closes is one without quotes. ' ' stands for tabs too.
std::size_t cell_end(std::string_view line, std::size_t begin, char delimiter);

// All cells, at least one, with their blanks and quotes. ' ' stands for runs of blanks and tabs; a line of these has no
// cell.
void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

// The text of a cell in quotes, "" a quote in it; others as they are.
std::string unquoted(std::string_view cell);

}  // namespace ballbar
