#include "recordings/column_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/error.hpp"
#include "logs/column_sample.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_plan.hpp"
#include "logs/log_shape.hpp"
#include "logs/log_sources.hpp"
#include "logs/log_text.hpp"
#include "logs/log_units.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostRows = 2000000;

// Columns that are numbers in most of the first rows.
std::vector<std::size_t> numeric_columns(const LogShape& shape) {
  std::vector<std::size_t> numbers(shape.headers.size(), 0);
  std::vector<std::string_view> cells;
  for (const HeadLine& row : shape.rows) {
    split_cells(row.text, shape.delimiter, cells);
    for (std::size_t i = 0; i < std::min(cells.size(), numbers.size()); ++i) {
      numbers[i] += cell_number(cells[i], shape.decimal).has_value();
    }
  }
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (2 * numbers[i] > shape.rows.size()) columns.push_back(i);
  }
  return columns;
}

// Whether a column has dates in most of the first rows.
bool has_dates(const LogShape& shape) {
  const std::vector<ColumnSample> samples = samples_of(shape);
  return std::any_of(samples.begin(), samples.end(), [](const ColumnSample& sample) {
    return sample.numbers == 0 && sample.mostly(sample.stamps + sample.dates);
  });
}

}  // namespace

ColumnTable column_table(std::string_view bytes, const std::string& name, const LogRecipe& recipe) {
  LogRecipe how = recipe;
  std::optional<TableText> text = table_text(bytes, name, how);
  if (text) how.delimiter = '\t';
  const Source source = Source::of_text(name, text ? std::move(text->text) : std::string(bytes));
  const LogShape shape = log_shape(source, how);
  const std::vector<std::size_t> places = numeric_columns(shape);
  ColumnTable table;
  for (const HeadLine& line : shape.preamble) table.preamble.push_back(line.text);
  Headers headers;
  std::vector<std::string> units;
  for (const std::size_t place : places) {
    const NameAndUnit header = name_and_unit(shape.headers[place]);
    const std::string& below = shape.units[place];
    units.push_back(below.empty() ? header.unit : below);
    headers.emplace_back(header.name.empty() ? fmt::format("c{}", place + 1) : shape.headers[place], header.name);
  }
  const std::vector<StatedColumn> stated = stated_columns(recipe, headers, units);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string& unit = stated[i].column.unit;
    table.columns.push_back({headers[i].second, unit.empty() ? units[i] : unit, {}});
  }
  table.dated = has_dates(shape);
  LogLines lines(source, shape.encoding);
  std::vector<std::string_view> cells;
  std::vector<double> row(places.size());
  std::size_t rows = 0;
  while (lines.next(true)) {
    if (lines.number() < shape.first_row_line) continue;
    split_cells(lines.line(), shape.delimiter, cells);
    const bool whole = std::all_of(places.begin(), places.end(), [&](const std::size_t& place) {
      if (place >= cells.size()) return false;
      const std::optional<double> value = cell_number(cells[place], shape.decimal);
      row[static_cast<std::size_t>(&place - places.data())] = value.value_or(0.0);
      return value && std::isfinite(*value);
    });
    if (!whole) continue;
    if (++rows > kMostRows) {
      throw Error(fmt::format("{}:{}: expected at most {} readings, found more.", name, lines.number(), kMostRows));
    }
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i].values.push_back(row[i]);
  }
  return table;
}

}  // namespace ballbar
