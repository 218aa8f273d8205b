// The position of the table in a log, and how its lines are split into cells.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/logs/log.hpp"
#include "logs/log_text.hpp"

namespace ballbar {

struct HeadLine {
  std::string text;
  std::size_t number = 0;
};

struct LogShape {
  TextEncoding encoding;
  char delimiter = ',';  // ' ': runs of blanks
  char decimal = '.';
  bool day_first = false;                       // by the writer's locale 03/04/2026 is the third of April
  std::size_t header_line = 0, units_line = 0;  // 0: none
  std::size_t first_row_line = 0;
  std::vector<std::string> headers, units;  // one a column, as written
  std::vector<bool> is_label;               // one a column: it holds the name or the unit of the one beside it
  std::string names_from;                   // in words: "names from line 2, units from line 3"
  std::vector<HeadLine> preamble;           // above the header
  std::vector<HeadLine> rows;               // the first ones, blank lines left out
  std::size_t bytes_a_row = 1;              // on the average
};

// Whether rows of numbers stand in the first bytes of a file.
bool holds_table(std::string_view head);

// From the first MiB. Throws Error with name:line if there is no table or two interpretations are possible.
LogShape log_shape(const Source& source, const LogRecipe& recipe);

}  // namespace ballbar
