#include "logs/column_sample.hpp"

#include <algorithm>
#include <cmath>

#include "logs/log_cells.hpp"
#include "logs/time_stamp.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

void look_at(std::string_view cell, char decimal, ColumnSample& sample) {
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
  const auto stamp = time_stamp(cell, DateOrder::day_first);
  if (!stamp) {
    ++sample.texts;
    return;
  }
  sample.day_first = sample.day_first || stamp->day_first_only;
  sample.month_first = sample.month_first || stamp->month_first_only;
  sample.either = sample.either || stamp->either_order;
  sample.minutes_and_seconds += stamp->minutes_and_seconds;
  sample.two_fields += stamp->two_fields;
  const double seconds = 86400.0 * static_cast<double>(stamp->day.value_or(0)) + stamp->clock_s.value_or(0.0);
  if (!sample.first_s) sample.first_s = seconds;
  sample.last_s = seconds;
  ++(stamp->day && stamp->clock_s ? sample.stamps : stamp->day ? sample.dates : sample.clocks);
}

}  // namespace

std::vector<ColumnSample> samples_of(const LogShape& shape) {
  std::vector<ColumnSample> samples(shape.headers.size());
  std::vector<std::string_view> cells;
  for (const HeadLine& row : shape.rows) {
    split_cells(row.text, shape.delimiter, cells);
    for (std::size_t i = 0; i < std::min(cells.size(), samples.size()); ++i)
      look_at(cells[i], shape.decimal, samples[i]);
  }
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

}  // namespace ballbar
