#include "logs/decimal_sign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "logs/log_cells.hpp"
#include "text/cells.hpp"

namespace ballbar {

void find_decimal(const std::string& name, const LogRecipe& recipe, LogShape& shape) {
  std::vector<std::string_view> cells;
  std::size_t sure_comma = 0, sure_point = 0, commas = 0, points = 0, integers = 0;
  std::string example;
  std::size_t example_line = 0;
  for (const HeadLine& row : shape.rows) {
    split_cells(row.text, shape.delimiter, cells);
    for (const std::string_view cell : cells) {
      const NumberLook look = look_of(cell);
      sure_comma += look.decimal == ',';
      sure_point += look.decimal == '.';
      commas += look.kind == NumberLook::Kind::comma;
      points += look.kind == NumberLook::Kind::point;
      integers += look.kind == NumberLook::Kind::integer;
      if (look.thousands && example.empty()) {
        example = trimmed_cell(cell);
        example_line = row.number;
      }
    }
  }
  if (recipe.decimal) {
    shape.decimal = *recipe.decimal;
    return;
  }
  const auto refuse = [&](const std::string& what, const std::string& found) {
    throw Error(fmt::format("{}:{}: expected {}, found {}; say --decimal comma or --decimal point.", name, example_line,
                            what, in_quotes(found)));
  };
  if (sure_comma > 0 && sure_point > 0) {
    // "1.234" of thousands beside "1,5" is sure by the comma; "0.5" beside "0,5" is two hands.
    if (sure_comma > 20 * sure_point || sure_point > 20 * sure_comma) {
      shape.decimal = sure_comma > sure_point ? ',' : '.';
      return;
    }
    if (shape.delimiter == ',') {
      shape.decimal = '.';
      return;
    }
    refuse("one decimal sign in all columns", "both comma and point");
  }
  if (sure_comma > 0 || sure_point > 0) {
    shape.decimal = sure_comma > 0 ? ',' : '.';
    return;
  }
  if (commas == 0 && points == 0) return;
  // Only numbers such as 1,234 or 20.000. Cells of one column that all have three digits behind the sign are decimals
  // printed to three places; thousands show smaller numbers without a sign beside them.
  if (commas > 0 && points > 0) refuse("a decimal sign that can be told", example);
  if (commas > 0 && shape.delimiter == ';') {
    shape.decimal = ',';
    return;
  }
  if (commas > 0 && shape.delimiter != ',') refuse("a number of one reading: decimals or thousands", example);
  if (commas > 0) {  // "1,234" in quotes between commas: thousands, as spreadsheets print them
    shape.decimal = '.';
    return;
  }
  if (points > 0 && shape.delimiter == ';' && integers > 0) {
    bool mixed = false;  // a column in which 800 stands beside 1.200
    std::vector<int> seen;
    for (const HeadLine& row : shape.rows) {
      split_cells(row.text, shape.delimiter, cells);
      seen.resize(std::max(seen.size(), cells.size()), 0);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const NumberLook look = look_of(cells[i]);
        seen[i] |= look.kind == NumberLook::Kind::integer ? 1 : look.kind == NumberLook::Kind::point ? 2 : 0;
        mixed = mixed || seen[i] == 3;
      }
    }
    if (mixed) refuse("a number of one reading: decimals or thousands", example);
  }
  shape.decimal = '.';
}

}  // namespace ballbar
