#include "logs/log_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "ballbar/numerics/order_statistic.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_layout.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr double kFewestRowsOfAChannel = 3.0;  // on the average
constexpr double kJump = 5.0, kNoJump = 1.5;   // from channel to channel, in steps within a channel
constexpr double kFewestChanges = 1.0 / 3.0;   // of the rows, where the time rises from row to row too
constexpr std::size_t kMostChannels = 1000;

using Cells = std::vector<std::string_view>;

std::string_view cell_of(const Cells& cells, std::size_t column) {
  return column < cells.size() ? trimmed_cell(cells[column]) : std::string_view();
}

bool names_channels(const PlannedColumn& column) {
  constexpr std::string_view kNames =
      "name|tag|channel|sensor|variable|signal|pv|varname|kanal|topic|entity|entity id|field|parameter|node|probe|"
      "device|metric|id|sensor id|source|ch|item|messstelle";
  return !column.headed || is_one_of(kNames, folded(column.name));
}

// The time of a row as it is written; nullopt: it has none.
std::optional<double> written_time(const TimePlan& time, const LogPlan& plan, const Cells& cells, char decimal) {
  if (time.kind == TimePlan::Kind::number) return cell_number(cell_of(cells, time.column), decimal);
  const DateOrder order = time.order.value_or(DateOrder::day_first);
  auto stamp = time_stamp(cell_of(cells, time.column), order);
  if (!stamp) return std::nullopt;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    if (plan.columns[i].kind != ColumnKind::clock) continue;
    const auto clock = time_stamp(cell_of(cells, i), order);
    if (clock) stamp->clock_s = clock->clock_s;
  }
  return static_cast<double>(stamp->day.value_or(0)) * kDay_s + stamp->clock_s.value_or(0.0);
}

// How the rows run if the words of one column are channels.
struct Evidence {
  std::map<std::string, std::size_t, std::less<>> rows_of;
  std::size_t rows = 0, changes = 0, not_rising = 0, falling_within = 0;
  std::vector<double> jumps, steps;  // of the value where the word changes: from the row before, from the same word
};

Evidence evidence_of(const LogShape& shape, const LogPlan& plan, std::size_t column, std::size_t value_column) {
  struct Last {
    double time = -INFINITY;
    std::optional<double> value;
  };
  std::map<std::string, Last, std::less<>> last_of;
  Evidence evidence;
  Cells cells;
  std::string before;
  Last last;
  for (const HeadLine& row : shape.rows) {
    split_cells(row.text, shape.delimiter, cells);
    const std::string word(cell_of(cells, column));
    std::optional<double> time = static_cast<double>(evidence.rows_of[word]);  // of rows without a clock
    if (plan.time.kind != TimePlan::Kind::rows) time = written_time(plan.time, plan, cells, shape.decimal);
    if (!time || word.empty()) continue;
    const auto value = cell_number(cell_of(cells, value_column), shape.decimal);
    Last& same = last_of[word];
    const bool changes = evidence.rows > 0 && word != before;
    evidence.changes += changes;
    evidence.not_rising += changes && !(*time > last.time) && plan.time.kind != TimePlan::Kind::rows;
    evidence.falling_within += *time < same.time;
    if (changes && value && last.value && same.value) {
      evidence.jumps.push_back(std::abs(*value - *last.value));
      evidence.steps.push_back(std::abs(*value - *same.value));
    }
    same = last = {*time, value};
    before = word;
    ++evidence.rows;
    ++evidence.rows_of[word];
  }
  return evidence;
}

// Whether the rows are those of channels. Throws Error where they may be those of one table as well.
bool are_channels(const Evidence& evidence, const LogShape& shape, const PlannedColumn& column,
                  const std::string& name) {
  const auto rows = static_cast<double>(evidence.rows);
  const std::size_t channels = evidence.rows_of.size();
  if (channels < 2 || channels > kMostChannels || rows < kFewestRowsOfAChannel * static_cast<double>(channels))
    return false;
  if (static_cast<double>(evidence.falling_within) > (1.0 - kExplained) * rows) return false;
  // As one table the time would stand still or fall wherever channels take turns.
  if (2 * evidence.not_rising > evidence.changes && evidence.not_rising > 0) return true;
  if (!names_channels(column) || static_cast<double>(evidence.changes) < kFewestChanges * rows ||
      evidence.jumps.size() < 3)
    return false;
  const double jump = median(evidence.jumps), step = median(evidence.steps);
  if (jump <= kNoJump * step) return false;
  if (jump >= kJump * step) return true;
  throw Error(fmt::format(
      "{}:{}: expected rows of one layout, found that they are one table or {} channels below each other, named in {}. "
      "For one table use --leave-out {}; else export a column for each channel.",
      name, shape.first_row_line, channels, in_quotes(column.source), column.source));
}

// The unit of each channel, where a column of words has units.
void take_units(const LogShape& shape, std::size_t channel, const std::vector<ColumnSample>& samples, LogPlan& plan) {
  Cells cells;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    if (i == channel || samples[i].texts == 0 || samples[i].texts != samples[i].written()) continue;
    std::map<std::string, std::string> units;
    for (const HeadLine& row : shape.rows) {
      split_cells(row.text, shape.delimiter, cells);
      const std::string_view unit = cell_of(cells, i);
      if (unit.empty()) continue;
      if (!log_unit(unit)) {
        units.clear();
        break;
      }
      units.emplace(cell_of(cells, channel), unit);
    }
    if (!units.empty()) plan.channel_units = std::move(units);
  }
}

}  // namespace

void find_channels(const LogShape& shape, const std::vector<ColumnSample>& samples, const std::string& name,
                   LogPlan& plan) {
  const auto is_time = [&](std::size_t i) { return plan.time.kind == TimePlan::Kind::number && i == plan.time.column; };
  // What is the same in all rows, or only rises, is a state or another time beside the values.
  const auto is_value = [&](std::size_t i) {
    const std::vector<double>& values = samples[i].values;
    return plan.columns[i].kind == ColumnKind::number && !is_time(i) && !plan.columns[i].is_switch && !values.empty() &&
           !samples[i].rises;
  };
  std::vector<std::size_t> values;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    if (is_value(i)) values.push_back(i);
  }
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    PlannedColumn& column = plan.columns[i];
    const bool is_words = column.kind == ColumnKind::left_out && samples[i].texts > 0 && samples[i].stamps == 0 &&
                          samples[i].numbers == 0 && samples[i].dates + samples[i].clocks == 0;
    const bool is_numbered = column.kind == ColumnKind::number && column.headed && names_channels(column) &&
                             samples[i].texts == 0 && !is_time(i) && all_whole(samples[i]);
    if (column.stated.left_out || !(is_words || is_numbered)) continue;
    const auto is_of_channels = [&](std::size_t value) {
      return value != i && are_channels(evidence_of(shape, plan, i, value), shape, column, name);
    };
    if (std::none_of(values.begin(), values.end(), is_of_channels)) continue;
    for (std::size_t k = 0; k < plan.columns.size(); ++k) {
      if (plan.columns[k].kind == ColumnKind::number && !is_time(k) && !is_value(k))
        plan.columns[k].kind = ColumnKind::label;
    }
    column.kind = ColumnKind::channel;
    take_units(shape, i, samples, plan);
    return;
  }
}

LogTable side_by_side(LogTable table, LogPlan& plan) {
  if (table.channels.empty()) return table;
  const bool has_stamps = plan.time.kind == TimePlan::Kind::stamps;
  const std::size_t channels = table.channels.size();
  // Of each row the time, and how often the channel had this time before.
  struct Place {
    double time;
    std::size_t again, row;
  };
  std::vector<Place> places;
  std::vector<double> last(channels, -INFINITY), added(channels, 0.0);
  std::vector<std::size_t> again(channels, 0), count(channels, 0);
  for (std::size_t row = 0; row < table.rows; ++row) {
    const std::size_t k = table.channel_of[row];
    double time = static_cast<double>(count[k]++);
    if (has_stamps) time = table.time_s[row] + added[k];
    if (plan.time.kind == TimePlan::Kind::number) time = table.values[plan.time.column][row];
    if (has_stamps && !table.first_day && time < last[k] - 0.5 * kDay_s) {  // past midnight
      added[k] += kDay_s;
      time += kDay_s;
    }
    again[k] = time == last[k] ? again[k] + 1 : 0;
    last[k] = time;
    places.push_back({time, again[k], row});
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.time, a.again) < std::tie(b.time, b.again);
  });
  LogTable wide;
  wide.first_day = table.first_day;
  wide.elapsed = table.elapsed;
  wide.zoned = table.zoned;
  wide.other_lines = table.other_lines;
  wide.without_time = table.without_time;
  wide.bad_lines = std::move(table.bad_lines);
  wide.cut_lines = std::move(table.cut_lines);
  std::vector<PlannedColumn> columns;
  std::vector<std::size_t> first_of(plan.columns.size());  // of a column of values, that of the first channel
  std::size_t values = 0;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) values += plan.columns[i].kind == ColumnKind::number;
  values -= plan.time.kind == TimePlan::Kind::number;
  std::size_t time_column = plan.time.column;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const PlannedColumn& column = plan.columns[i];
    first_of[i] = columns.size();
    if (plan.time.column == i) time_column = columns.size();
    const bool is_time = plan.time.kind == TimePlan::Kind::number && plan.time.column == i;
    if (column.kind != ColumnKind::number || is_time) {
      if (column.kind != ColumnKind::channel && column.kind != ColumnKind::left_out) columns.push_back(column);
      continue;
    }
    for (const std::string& channel : table.channels) {
      PlannedColumn one = column;
      one.source = values > 1 ? fmt::format("{} {}", channel, column.source) : channel;
      one.stated = {};
      const NameAndUnit split = name_and_unit(one.source);
      one.name = split.name;
      const auto unit = plan.channel_units.find(channel);
      one.unit = !split.unit.empty() ? split.unit : unit != plan.channel_units.end() ? unit->second : column.unit;
      one.headed = true;
      columns.push_back(std::move(one));
    }
  }
  wide.values.resize(columns.size());
  for (std::size_t at = 0; at < places.size(); ++at) {
    const auto& [time, times, row] = places[at];
    if (at == 0 || time != places[at - 1].time || times != places[at - 1].again) {
      wide.lines.emplace_back(wide.rows++, table.line_of(row));
      if (has_stamps) wide.time_s.push_back(time);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].kind == ColumnKind::number) wide.values[i].push_back(kGap);
      }
      if (plan.time.kind == TimePlan::Kind::number) wide.values[time_column].back() = time;
    }
    for (std::size_t i = 0; i < plan.columns.size(); ++i) {
      const bool is_time = plan.time.kind == TimePlan::Kind::number && plan.time.column == i;
      if (plan.columns[i].kind != ColumnKind::number || is_time) continue;
      wide.values[first_of[i] + table.channel_of[row]].back() = table.values[i][row];
    }
  }
  plan.columns = std::move(columns);
  plan.time.column = time_column;
  return wide;
}

}  // namespace ballbar
