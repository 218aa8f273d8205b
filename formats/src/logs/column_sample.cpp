#include "logs/column_sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "logs/time_stamp.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostWords = 1000;

bool has_four_digits(std::string_view cell) {
  std::size_t digits = 0;
  for (const char c : cell) {
    digits = is_digit(c) ? digits + 1 : 0;
    if (digits == 4) return true;
  }
  return false;
}

void look_at(std::string_view cell, char decimal, ColumnSample& sample) {
  if (switch_value(cell)) {
    ++sample.switches;
    sample.switch_words.insert(folded(trimmed_cell(cell)));
  }
  if (is_missing(cell)) {
    ++sample.missing;
    return;
  }
  cell = trimmed_cell(cell);
  if (const auto value = cell_number(cell, decimal)) {
    ++sample.numbers;
    if (!sample.values.empty()) {
      sample.rises = sample.rises && *value >= sample.values.back();
      sample.ever_rises = sample.ever_rises || *value > sample.values.back();
    }
    sample.values.push_back(*value);
    // 20261122130510, 20261122 and 130510 are numbers too.
    const bool digits = cell.find_first_not_of("0123456789") == std::string_view::npos;
    if (digits && cell.size() == 14 && time_stamp(cell, DateOrder::day_first)) ++sample.stamps;
    if (digits && cell.size() == 8 && time_stamp(cell, DateOrder::day_first)) ++sample.packed_dates;
    if (digits && cell.size() == 6 && time_stamp(cell, DateOrder::day_first)) ++sample.packed_clocks;
    return;
  }
  if (const auto clock = clock_of_dots(cell, decimal == ',')) {
    ++sample.dotted_clocks;
    const double clock_s = time_stamp(*clock, DateOrder::day_first)->clock_s.value_or(0.0);
    sample.dotted_clocks_fall = sample.dotted_clocks_fall || clock_s < sample.last_clock_s;
    sample.last_clock_s = clock_s;
    if (sample.last_fields.size() < 2) sample.last_fields.insert(clock->substr(clock->rfind(':') + 1, 2));
  }
  const auto stamp = time_stamp(cell, DateOrder::day_first);
  if (!stamp) {
    ++sample.texts;
    if (sample.words.size() < kMostWords) sample.words.emplace(cell);
    return;
  }
  sample.day_first = sample.day_first || stamp->day_first_only;
  sample.month_first = sample.month_first || stamp->month_first_only;
  sample.either = sample.either || stamp->either_order;
  sample.minutes_and_seconds += stamp->minutes_and_seconds;
  sample.two_fields += stamp->two_fields;
  sample.two_fields_return = sample.two_fields_return || (stamp->two_fields && sample.has_three_fields);
  sample.has_three_fields = sample.has_three_fields || (stamp->clock_s && !stamp->day && !stamp->two_fields);
  sample.sure_dates += stamp->day && (cell.find('.') != std::string_view::npos || has_four_digits(cell));
  sample.lacks_year += stamp->lacks_year;
  sample.midnights += stamp->day && stamp->clock_s == 0.0;
  const double seconds = 86400.0 * static_cast<double>(stamp->day.value_or(0)) + stamp->clock_s.value_or(0.0);
  if (!sample.first_s) sample.first_s = seconds;
  sample.last_s = seconds;
  ++(stamp->day && stamp->clock_s ? sample.stamps : stamp->day ? sample.dates : sample.clocks);
}

// "21,72" of "21,72 °C".
std::string_view without_unit(std::string_view cell) {
  cell = trimmed_cell(cell);
  const std::size_t end = std::min(cell.find_first_not_of("0123456789.,+-"), cell.size());
  return end > 0 && end < cell.size() && log_unit(trimmed_cell(cell.substr(end))) ? cell.substr(0, end) : cell;
}

bool names_a_clock(std::string_view header) {
  constexpr std::string_view kNames =
      "time|zeit|uhrzeit|ora|ore|orario|tempo|hora|heure|tid|tidspunkt|klokkeslaet|klokkeslett|klokken|klo|kl|aika|"
      "kello|"
      "kellonaika|clock|time of day|elapsed|laufzeit|messzeit|时间|時間|時刻";
  const NameAndUnit split = name_and_unit(header);
  return !time_unit_s(split.unit) && is_one_of(kNames, folded(split.name));
}

// Under a name of a clock 07.05.00 is one, unless all cells are dates of one year but 2000, 07.05.26, or would be
// clocks that fall.
void find_dotted_clocks(const std::vector<std::string>& headers, std::vector<ColumnSample>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ColumnSample& sample = samples[i];
    const bool is_one_year = sample.last_fields.size() == 1 && *sample.last_fields.begin() != "00";
    const bool are_dates = sample.dates == sample.dotted_clocks && (is_one_year || sample.dotted_clocks_fall);
    if (sample.dotted_clocks == 0 || sample.dotted_clocks + sample.clocks != sample.written() || are_dates ||
        !names_a_clock(headers[i]))
      continue;
    sample.has_dotted_clocks = true;
    sample.clocks += sample.dotted_clocks;
    sample.dates = sample.texts = 0;
    sample.words.clear();
    sample.first_s.reset();
    sample.last_s.reset();
  }
}

}  // namespace

std::vector<ColumnSample> samples_of(const LogShape& shape, std::size_t rows) {
  std::vector<ColumnSample> samples(shape.headers.size());
  std::vector<std::string_view> cells;
  for (std::size_t row = 0; row < std::min(rows, shape.rows.size()); ++row) {
    split_cells(shape.rows[row].text, shape.delimiter, cells);
    for (std::size_t i = 0; i < std::min(cells.size(), samples.size()); ++i)
      look_at(cells[i], shape.decimal, samples[i]);
  }
  find_dotted_clocks(shape.headers, samples);
  return samples;
}

bool all_whole(const ColumnSample& sample) {
  return std::all_of(sample.values.begin(), sample.values.end(), [](double v) { return v == std::floor(v); });
}

bool runs_as_long(const ColumnSample& numbers, double unit_s, const ColumnSample& stamps) {
  const double by_numbers_s = (numbers.values.back() - numbers.values.front()) * unit_s;
  const double by_stamps_s = *stamps.last_s - *stamps.first_s;
  return std::abs(by_numbers_s - by_stamps_s) < 2.0 + 0.02 * std::abs(by_stamps_s);
}

bool counts_rows(const ColumnSample& sample, bool gaps) {
  if (sample.values.size() < 2 || (!gaps && sample.numbers != sample.written())) return false;
  std::size_t next = 0;
  for (std::size_t i = 1; i < sample.values.size(); ++i) {
    if (sample.values[i] <= sample.values[i - 1]) return false;
    next += sample.values[i] == sample.values[i - 1] + 1.0;
  }
  const std::size_t steps = sample.values.size() - 1;
  return all_whole(sample) && (next == steps || (gaps && next * 10 >= steps * 9));
}

void find_decimal(const std::string& name, std::span<const HeadLine> above, const LogRecipe& recipe, LogShape& shape) {
  std::vector<std::string_view> cells;
  std::vector<bool> is_clock(shape.headers.size(), false);
  for (const HeadLine& line : above) {
    split_cells(line.text, shape.delimiter, cells);
    for (std::size_t i = 0; i < std::min(cells.size(), is_clock.size()); ++i)
      is_clock[i] = is_clock[i] || names_a_clock(trimmed_cell(cells[i]));
  }
  std::size_t sure_comma = 0, sure_point = 0, commas = 0, points = 0, integers = 0;
  std::string example;
  std::size_t example_line = 0;
  for (const HeadLine& row : shape.rows) {
    split_cells(row.text, shape.delimiter, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string_view cell = cells[i];
      const NumberLook look = look_of(without_unit(cell));
      const bool may_be_clock = look.decimal == '.' && i < is_clock.size() && is_clock[i];
      if (may_be_clock && clock_of_dots(trimmed_cell(cell), true)) continue;
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
    throw Error(fmt::format("{}:{}: expected {}, found {}. State --decimal comma or --decimal point.", name,
                            example_line > 0 ? example_line : shape.first_row_line, what, in_quotes(found)));
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
    refuse("one decimal separator in all columns", "both comma and point");
  }
  if (sure_comma > 0 || sure_point > 0) {
    shape.decimal = sure_comma > 0 ? ',' : '.';
    return;
  }
  if (commas == 0 && points == 0) return;
  // Only numbers such as 1,234 or 20.000. Cells of one column that all have three digits behind the sign are decimals
  // printed to three places; thousands show smaller numbers without a sign beside them.
  if (commas > 0 && points > 0) refuse("a clear decimal separator", example);
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
    std::vector<int> kinds;
    for (const HeadLine& row : shape.rows) {
      split_cells(row.text, shape.delimiter, cells);
      kinds.resize(std::max(kinds.size(), cells.size()), 0);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const NumberLook look = look_of(cells[i]);
        kinds[i] |= look.kind == NumberLook::Kind::integer ? 1 : look.kind == NumberLook::Kind::point ? 2 : 0;
        mixed = mixed || kinds[i] == 3;
      }
    }
    if (mixed) refuse("a number of one reading: decimals or thousands", example);
  }
  shape.decimal = '.';
}

}  // namespace ballbar
