// The columns of a table of text as numbers, and the text above it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/text/log_recipe.hpp"

namespace ballbar {

struct NumberColumn {
  std::string name, unit;      // as the header has them; empty: none
  std::vector<double> values;  // one a row
};

struct ColumnTable {
  std::vector<NumberColumn> columns;  // rows in which one of them has no number are left out
  std::vector<std::string> preamble;  // lines above the header
  bool dated = false;                 // another column has dates
};

// Text, or a sheet of a workbook. A column of no more than words is left out; the recipe states units. Throws Error
// with name:line: no table, more than 2 000 000 rows.
ColumnTable column_table(std::string_view bytes, const std::string& name, const LogRecipe& recipe = {});

}  // namespace ballbar
