#include "logs/log_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_header.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestRowsOfAChannel = 3;  // on the average
constexpr double kJump = 5.0, kNoJump = 1.5;      // from channel to channel, in steps within a channel
constexpr std::size_t kRowsOfAChange = 3;         // at most, where the time rises from row to row too
constexpr std::size_t kMostCells = std::size_t{1} << 27;

bool names_channels(const PlannedColumn& column) {
  constexpr std::string_view kNames =
      "name|tag|channel|sensor|variable|signal|pv|varname|kanal|topic|entity|entity id|field|parameter|node|probe|"
      "device|metric|id|sensor id|source|ch|item|messstelle|point|target|punkt|ziel";
  return !column.headed || is_one_of(kNames, folded(column.name));
}

// Where each row belongs: its time, as its channel has it, and how often the channel had this time before.
struct Place {
  double time;
  std::size_t again, row;
};

struct Evidence {
  std::size_t changes = 0, not_rising = 0, falling = 0;  // of the channel; of the time then; within a channel
  std::vector<Place> places;
};

Evidence evidence_of(const LogTable& table, const LogPlan& plan) {
  struct Last {
    double time = -INFINITY, added = 0.0;
    std::size_t again = 0, count = 0;
  };
  std::vector<Last> last_of(table.channels.size());
  Evidence evidence;
  const bool has_stamps = plan.time.kind == TimePlan::Kind::stamps, has_clock = plan.time.kind != TimePlan::Kind::rows;
  for (std::size_t row = 0; row < table.rows; ++row) {
    Last& last = last_of[table.channel_of[row]];
    double time = has_stamps  ? table.time_s[row] + last.added
                  : has_clock ? table.values[plan.time.column][row]
                              : static_cast<double>(last.count++);
    if (has_stamps && !table.first_day && time < last.time - 0.5 * kDay_s) {  // past midnight
      last.added += kDay_s;
      time += kDay_s;
    }
    const bool changes = row > 0 && table.channel_of[row] != table.channel_of[row - 1];
    evidence.changes += changes;
    evidence.not_rising += changes && has_clock && !(time > evidence.places.back().time);
    evidence.falling += time < last.time;
    last.again = time == last.time ? last.again + 1 : 0;
    last.time = time;
    evidence.places.push_back({time, last.again, row});
  }
  return evidence;
}

// How far values jump where the channel changes, in steps from the last value of the same channel.
double jump_of(const LogTable& table, const std::vector<double>& values) {
  std::vector<double> last_of(table.channels.size(), kGap), jumps, steps;
  for (std::size_t row = 0; row < table.rows; ++row) {
    double& last = last_of[table.channel_of[row]];
    const bool changes = row > 0 && table.channel_of[row] != table.channel_of[row - 1];
    if (changes && std::isfinite(values[row]) && std::isfinite(values[row - 1]) && std::isfinite(last)) {
      jumps.push_back(std::abs(values[row] - values[row - 1]));
      steps.push_back(std::abs(values[row] - last));
    }
    last = values[row];
  }
  if (jumps.size() < kFewestRowsOfAChannel) return 0.0;
  const double jump = median(std::move(jumps)), step = median(std::move(steps));
  return jump == 0.0 ? 0.0 : jump / step;
}

// What is the same in all rows, or only rises, is a state or another time beside the values of channels.
bool is_value(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater<>()) != values.end();
}

bool are_channels(const LogTable& table, const LogPlan& plan, const Evidence& evidence, const PlannedColumn& names,
                  const std::string& name) {
  const std::size_t channels = table.channels.size();
  if (channels < 2 || table.rows < kFewestRowsOfAChannel * channels) return false;
  if (static_cast<double>(evidence.falling) > (1.0 - kExplained) * static_cast<double>(table.rows)) return false;
  // As one table the time would stand still or fall wherever channels take turns.
  if (evidence.not_rising > 0 && 2 * evidence.not_rising > evidence.changes) return true;
  if (names.has_ids || !names_channels(names) || kRowsOfAChange * evidence.changes < table.rows) return false;
  double jump = 0.0;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    if (plan.columns[i].kind == ColumnKind::number && !is_time(plan, i) && is_value(table.values[i]))
      jump = std::max(jump, jump_of(table, table.values[i]));
  }
  if (jump >= kJump || jump <= kNoJump) return jump >= kJump;
  throw Error(fmt::format(
      "{}:{}: expected rows of one layout, found that they are one table or {} channels below each other, named in {}. "
      "For one table use --leave-out {}; else export a column for each channel.",
      name, table.line_of(0), channels, in_quotes(names.source), names.source));
}

}  // namespace

void find_channel_names(const LogShape& shape, const std::vector<ColumnSample>& samples, LogPlan& plan) {
  std::optional<std::size_t> channel;
  for (std::size_t i = 0; i < plan.columns.size() && !channel; ++i) {
    const ColumnSample& sample = samples[i];
    const PlannedColumn& column = plan.columns[i];
    const bool may_name = column.kind == ColumnKind::words || column.kind == ColumnKind::left_out;
    const bool is_text = may_name && !column.stated.left_out && sample.texts > 0 && sample.texts == sample.written();
    const std::set<double> ids(sample.values.begin(), sample.values.end());
    const bool is_id = column.kind == ColumnKind::number && column.headed && sample.texts == 0 &&
                       names_channels(column) && all_whole(sample);
    const std::size_t channels = is_text ? sample.words.size() : is_id ? ids.size() : 0;
    if (channels > 1 && kFewestRowsOfAChannel * channels <= sample.written()) channel = i;
  }
  if (!channel) return;
  plan.columns[*channel].has_ids = plan.columns[*channel].kind == ColumnKind::number;
  plan.columns[*channel].kind = ColumnKind::channel;
  std::vector<std::string_view> cells;
  for (const HeadLine& row : shape.rows) {
    split_cells(row.text, shape.delimiter, cells);
    for (std::size_t i = 0; i < std::min(cells.size(), samples.size()); ++i) {
      const std::string_view unit = trimmed_cell(cells[i]);
      if (i != *channel && *channel < cells.size() && samples[i].texts == samples[i].written() && log_unit(unit))
        plan.channel_units.emplace(trimmed_cell(cells[*channel]), unit);
    }
  }
}

LogTable side_by_side(LogTable table, const std::string& name, LogPlan& plan) {
  const auto names = std::find_if(plan.columns.begin(), plan.columns.end(),
                                  [](const PlannedColumn& column) { return column.kind == ColumnKind::channel; });
  if (names == plan.columns.end()) return table;
  Evidence evidence = evidence_of(table, plan);
  if (!are_channels(table, plan, evidence, *names, name)) {
    names->why = "text";
    const auto place = static_cast<std::size_t>(names - plan.columns.begin());
    std::vector<double>& values = table.values[place];
    if (names->has_ids) {
      names->kind = ColumnKind::number;
      for (const std::uint32_t channel : table.channel_of)
        values.push_back(cell_number(table.channels[channel], '.').value_or(kGap));
    } else {
      names->kind = ColumnKind::words;
      values.assign(table.channel_of.begin(), table.channel_of.end());
      table.words[place] = table.channels;
    }
    return table;
  }
  if (names->has_ids) {
    for (std::string& channel : table.channels) channel = fmt::format("{} {}", names->source, channel);
  }
  std::vector<Place>& places = evidence.places;
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.time, a.again) < std::tie(b.time, b.again);
  });
  LogPlan wide_plan = plan;
  wide_plan.columns.clear();
  std::vector<std::pair<std::size_t, std::size_t>> values;  // columns: in the table, of its first channel
  for (const bool any : {false, true}) {
    for (std::size_t i = 0; i < plan.columns.size(); ++i) {
      const bool is_number = plan.columns[i].kind == ColumnKind::number && !is_time(plan, i);
      if (is_number && (any || (is_value(table.values[i]) && !plan.columns[i].is_switch))) values.emplace_back(i, 0);
    }
    if (!values.empty()) break;
  }
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const PlannedColumn& column = plan.columns[i];
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& one) { return one.first == i; });
    if (i == plan.time.column) wide_plan.time.column = wide_plan.columns.size();
    if (value == values.end()) {
      const bool is_of_time =
          is_time(plan, i) || (column.kind != ColumnKind::number && column.kind != ColumnKind::channel);
      if (is_of_time && column.kind != ColumnKind::left_out) wide_plan.columns.push_back(column);
      continue;
    }
    value->second = wide_plan.columns.size();
    for (const std::string& channel : table.channels) {
      PlannedColumn one = column;
      one.source = values.size() > 1 ? fmt::format("{} {}", channel, column.source) : channel;
      const NameAndUnit split = name_and_unit(one.source);
      one.name = split.name;
      const auto unit = plan.channel_units.find(channel);
      if (!split.unit.empty())
        one.unit = split.unit;
      else if (unit != plan.channel_units.end())
        one.unit = unit->second;
      one.headed = true;
      wide_plan.columns.push_back(std::move(one));
    }
  }
  if (table.rows > kMostCells / wide_plan.columns.size()) {
    throw Error(fmt::format("{}:{}: expected channels that fit into memory side by side, found {} in {} rows.", name,
                            table.line_of(0), table.channels.size(), table.rows));
  }
  LogTable wide = std::move(table);  // with what was said of its lines
  const auto narrow_values = std::exchange(wide.values, std::vector<std::vector<double>>(wide_plan.columns.size()));
  const auto channel_of = std::exchange(wide.channel_of, {});
  const LogTable narrow{.lines = std::exchange(wide.lines, {})};
  wide.rows = wide.short_rows = 0;
  wide.time_s.clear();
  for (std::size_t at = 0; at < places.size(); ++at) {
    const auto& [time, again, row] = places[at];
    if (at == 0 || time != places[at - 1].time || again != places[at - 1].again) {
      wide.lines.emplace_back(wide.rows++, narrow.line_of(row));
      if (plan.time.kind == TimePlan::Kind::stamps) wide.time_s.push_back(time);
      for (std::size_t i = 0; i < wide.values.size(); ++i) {
        if (wide_plan.columns[i].kind == ColumnKind::number)
          wide.values[i].push_back(is_time(wide_plan, i) ? time : kGap);
      }
    }
    for (const auto& [from, first] : values) wide.values[first + channel_of[row]].back() = narrow_values[from][row];
  }
  plan = std::move(wide_plan);
  return wide;
}

}  // namespace ballbar
