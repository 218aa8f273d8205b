#include "ballbar/formats/logs/log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "ballbar/numerics/order_statistic.hpp"
#include "logs/log_clock.hpp"
#include "logs/log_columns.hpp"
#include "logs/log_plan.hpp"
#include "logs/log_roles.hpp"
#include "logs/log_shape.hpp"
#include "logs/log_sources.hpp"
#include "logs/log_table.hpp"
#include "logs/log_temperatures.hpp"
#include "logs/log_units.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kListedLines = 10;  // of those that are skipped
constexpr std::size_t kProbesAtMost = 3;  // that no name tells
constexpr double kBetweenBursts = 5.0;    // times the middle step of time

std::string shape_text(const LogShape& shape) {
  const std::string_view delimiter = shape.delimiter == ';'    ? "semicolons"
                                     : shape.delimiter == '\t' ? "tabs"
                                     : shape.delimiter == ' '  ? "blanks"
                                     : shape.delimiter == '|'  ? "bars"
                                                               : "commas";
  return fmt::format("{}, decimal {}, {}", delimiter, shape.decimal == ',' ? "comma" : "point", shape.encoding.name);
}

LogRecipe recipe_of(const Log& log, const LogShape& shape, const LogPlan& plan, const LogRecipe& given) {
  LogRecipe recipe = given;
  recipe.delimiter = shape.delimiter;
  recipe.decimal = shape.decimal;
  const TimePlan& time = plan.time;
  if (time.numbered)
    recipe.time = "none";
  else if (time.kind == TimePlan::Kind::rows)
    recipe.every_s = time.every_s;
  else
    recipe.time = plan.columns[time.column].source;
  if (time.kind == TimePlan::Kind::stamps && time.order) recipe.month_first = *time.order == DateOrder::month_first;
  recipe.columns.clear();
  for (const LogColumn& column : log.columns) {
    recipe.columns.push_back({column.source, column.name, column.found_unit.empty() ? column.unit : column.found_unit,
                              column.role, column.name.empty()});
  }
  return recipe;
}

void say_lines(const LogTable& table, Log& log) {
  const auto lines = [](std::size_t count) { return fmt::format("{} {}", count, count == 1 ? "line" : "lines"); };
  if (table.other_lines > 0)
    log.remarks.push_back(
        fmt::format("{} of comments, names or text after the rows: ignored.", lines(table.other_lines)));
  if (table.without_time > 0)
    log.remarks.push_back(fmt::format("{} without a time: left out.", lines(table.without_time)));
  if (table.short_rows > 0)
    log.remarks.push_back(fmt::format("{} with fewer values than columns: filled with gaps.", lines(table.short_rows)));
  const auto say = [&](const std::vector<std::size_t>& numbers, std::string_view what) {
    if (numbers.empty()) return;
    const std::size_t some = std::min(kListedLines, numbers.size());
    log.remarks.push_back(
        fmt::format("{} {}: {} {}{}.", lines(numbers.size()), what, numbers.size() == 1 ? "line" : "lines",
                    fmt::join(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(some), ", "),
                    numbers.size() > some ? fmt::format(" and {} more", numbers.size() - some) : ""));
  };
  say(table.bad_lines, "skipped, not a row of numbers");
  say(table.cut_lines, "cut off within a number, read as a gap");
}

// What a user should state, where the file does not tell it.
std::vector<std::string> unclear_parts(const Log& log) {
  std::vector<std::string> parts;
  if (!log.series.has_clock)
    parts.emplace_back("No column holds the time, and no line states the interval of the rows.");
  bool measured = false;
  for (const LogColumn& column : log.columns) {
    if (column.name.empty()) continue;
    measured = measured || column.role == Role::measured;
    if (column.role == Role::measured && column.unit.empty() && column.found_unit.empty())
      parts.push_back(fmt::format("{} has no unit.", column.source));
    if (column.role == Role::event && column.why.ends_with('?'))
      parts.push_back(fmt::format("{}: {}", column.source, column.why));
  }
  if (!measured) parts.emplace_back("No measured column was found.");
  return parts;
}

// Columns of the log that the series has, with their values.
std::vector<std::pair<LogColumn*, Column*>> taken_columns(Log& log) {
  std::vector<std::pair<LogColumn*, Column*>> taken;
  for (LogColumn& column : log.columns) {
    if (!column.name.empty()) taken.emplace_back(&column, &log.series.columns[taken.size()]);
  }
  return taken;
}

// A bare X, Y or Z without a unit is the place of an axis where another column is measured in one. Where none is, the
// columns that may be are, if they are three at most: "mcu_pos_z".
void settle_targets(Log& log) {
  const auto taken = taken_columns(log);
  const auto is_axis = [](const LogColumn& column) {
    return !column.role_is_stated && column.unit.empty() && column.found_unit.empty() && names_an_axis(column.source);
  };
  const bool any = std::any_of(taken.begin(), taken.end(), [&](const auto& one) {
    return one.first->role == Role::measured && !one.first->unit.empty() && !is_axis(*one.first);
  });
  const auto set = [](const auto& one, Role role, std::string_view why) {
    one.first->role = one.second->role = role;
    one.first->why = why;
  };
  std::vector<std::pair<LogColumn*, Column*>> found;
  for (const auto& one : taken) {
    const LogColumn& column = *one.first;
    if (any && column.role == Role::measured && is_axis(column)) set(one, Role::event, "an axis position, by its name");
    const Extremes range = extremes_of(one.second->values);
    const bool may_be = column.role == Role::event && !column.role_is_stated && column.unit.empty() &&
                        column.found_unit.empty() && range.most > range.least && could_be_measured(column.source);
    if (may_be) found.push_back(one);
  }
  const bool none =
      std::none_of(taken.begin(), taken.end(), [](const auto& one) { return one.first->role == Role::measured; });
  if (!none || found.size() > kProbesAtMost) return;
  for (const auto& one : found) set(one, Role::measured, "the only possible measured column, in which unit?");
}

// A row a burst: the mean of its rows, at the mean of their times. Bursts are parted by steps of time that are far
// longer than the middle one. Throws Error where there are none.
void take_burst_means(Series& series, const std::string& name) {
  const double longest_s = kBetweenBursts * median_step_s(series.time_s);
  std::vector<std::size_t> begins{0};
  for (std::size_t row = 1; row < series.time_s.size(); ++row) {
    if (series.time_s[row] - series.time_s[row - 1] > longest_s) begins.push_back(row);
  }
  if (begins.size() < 2) throw Error(fmt::format("{}: expected rows in bursts for --burst-means, found none.", name));
  begins.push_back(series.time_s.size());
  const auto means = [&](const std::vector<double>& of) {
    std::vector<double> mean;
    mean.reserve(begins.size() - 1);
    for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
      double sum = 0.0;
      std::size_t count = 0;
      for (std::size_t row = begins[k]; row < begins[k + 1]; ++row) {
        if (!std::isfinite(of[row])) continue;
        sum += of[row];
        ++count;
      }
      mean.push_back(count == 0 ? kGap : sum / static_cast<double>(count));
    }
    return mean;
  };
  series.time_s = means(series.time_s);
  for (Column& column : series.columns) column.values = means(column.values);
}

constexpr double kNoReading = 9e36;  // 9.9E37 and 1E38 stand for overload

// Numbers that loggers write where there is no value; only where they stand far outside all others.
constexpr double kSentinels[] = {-999.0,  -9999.0, -99999.0, -999.9,   -999.99, -9999.9, -99.9,
                                 -99.99,  -273.15, 999.9,    9999.0,   9999.9,  99999.0, 32767.0,
                                 65535.0, 3276.7,  6553.5,   -32768.0, -1e6,    1e6,     -3276.8};

// Turns numbers that loggers write where there is no value into gaps where they lie far outside all other values;
// returns the numbers and how often each was found, or nothing.
std::string take_missing_values(std::vector<double>& values) {
  std::string found;
  const auto take_out = [&](auto is_none) {
    std::size_t count = 0;
    double example = 0.0;
    for (double& value : values) {
      if (!is_none(value)) continue;
      example = value;
      value = kGap;
      ++count;
    }
    if (count > 0) found += fmt::format("{}{} times {:g}", found.empty() ? "" : ", ", count, example);
  };
  for (int side = 0; side < 4; ++side) {
    const Extremes all = extremes_of(values);
    if (std::abs(all.least) >= kNoReading || std::abs(all.most) >= kNoReading) {
      take_out([](double v) { return std::abs(v) >= kNoReading; });
      continue;
    }
    const auto is_known = [](double v) {
      return std::find(std::begin(kSentinels), std::end(kSentinels), v) != std::end(kSentinels);
    };
    const bool low = is_known(all.least), high = is_known(all.most);
    if (!low && !high) break;
    bool any = false;
    for (const double one : {low ? all.least : kGap, high ? all.most : kGap}) {
      if (std::isnan(one)) continue;
      const Extremes rest = extremes_of(values, one);
      const double far = 3.0 * (rest.most - rest.least) + 50.0;
      if (!(one < rest.least - far || one > rest.most + far)) continue;
      take_out([&](double v) { return v == one; });
      any = true;
    }
    if (!any) break;
  }
  return found;
}

// `joined`: columns that the recipe names may be in another file.
Log log_of(const Source& source, const LogRecipe& recipe, bool joined) {
  const std::string& name = source.name();
  const LogShape shape = log_shape(source, recipe);
  LogPlan plan = log_plan(shape, name, recipe);
  if (!joined) {
    Headers headers;
    for (const PlannedColumn& column : plan.columns) headers.emplace_back(column.source, column.name);
    expect_recipe_columns(headers, name, std::max<std::size_t>(1, shape.header_line), recipe);
  }
  LogTable table = log_table(source, shape, plan, recipe);
  if (table.rows < 2) {
    throw Error(fmt::format("{}:{}: expected at least two rows, found {}.", name, shape.first_row_line, table.rows));
  }
  Log log;
  log.shape = shape_text(shape);
  log.time = plan.time.text;
  log.first_row_line = shape.first_row_line;
  say_lines(table, log);
  log.skipped_lines = table.bad_lines;
  log.without_row = table.without_row;
  std::optional<double> started_s;
  log.series.time_s = clock_s(table, plan, name, started_s, log.remarks);
  log.series.has_clock = !plan.time.numbered;
  if (started_s) log.series.started = stamp_text(*started_s);
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    if (plan.columns[i].kind != ColumnKind::number) continue;
    const std::string gone = take_missing_values(table.values[i]);
    if (!gone.empty())
      log.remarks.push_back(fmt::format("{}: {}: read as a missing value.", plan.columns[i].source, gone));
  }
  std::vector<std::string> assumed(plan.columns.size());
  for (const TemperatureFamily& family : temperatures_among(plan, table.values)) {
    for (const std::size_t i : family.columns) {
      plan.columns[i].unit = "degC";
      assumed[i] = "by name and values";
    }
    log.remarks.push_back(family.text);
  }
  std::set<std::string> taken;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const PlannedColumn& column = plan.columns[i];
    const bool is_time = column.kind != ColumnKind::number && column.kind != ColumnKind::left_out;
    if (is_time || (plan.time.kind == TimePlan::Kind::number && i == plan.time.column)) continue;
    if (column.kind == ColumnKind::left_out) {
      log.columns.push_back({column.source, "", column.unit, "", Role::event, false, column.why, 0, {}});
    } else {
      take_column(column, std::move(table.values[i]), assumed[i], name, log, taken);
      if (!assumed[i].empty()) log.columns.back().found_unit.clear();
    }
  }
  if (log.series.columns.empty())
    throw Error(fmt::format("{}:{}: expected a column with values, found none.", name, shape.first_row_line));
  log.recipe = recipe_of(log, shape, plan, recipe);
  return log;
}

// The log of a file, whatever it is; those of Source::recipe().join not yet beside it.
Log one_log(const Source& source, const LogRecipe& recipe, bool joined) {
  if (!is_table_file(source.head(512))) return log_of(source, recipe, joined);
  auto text = table_text(source.bytes(kLargestTable), source.name(), recipe);
  LogRecipe tabs = recipe;
  tabs.delimiter = '\t';
  Log log = [&] {
    try {
      return log_of(Source::of_text(text->name, std::move(text->text)), tabs, joined);
    } catch (const Error& error) {
      if (text->sheet.empty()) throw;
      throw Error(
          fmt::format("{} In the sheet {}. Choose another with --sheet.", error.what(), in_quotes(text->sheet)));
    }
  }();
  log.shape = text->shape;
  log.sheet = text->sheet;
  log.sheets = std::move(text->sheets);
  if (recipe.sheet.empty() && log.sheets.size() > 1) {
    log.remarks.push_back(fmt::format("One of {} sheets is read, {}. Choose another with --sheet.", log.sheets.size(),
                                      in_quotes(log.sheet)));
  }
  log.recipe.delimiter.reset();
  log.recipe.decimal.reset();
  return log;
}

// Another file, to be joined row by row.
Log beside_of(const Log& log, const Source& source, const std::string& file, const LogRecipe& recipe) {
  LogRecipe other = recipe;
  other.sheet = log.sheet;
  other.time = "none";
  other.every_s.reset();
  std::error_code absent;
  if (std::filesystem::equivalent(file, source.path(), absent))
    throw Error(fmt::format("{}: expected another file for --join, found the same.", file));
  return one_log(file, other, true);
}

void expect_rows_alone(const Log& log, const std::string& name) {
  const std::size_t others = log.without_row + (log.series.has_clock ? log.skipped_lines.size() : 0);
  if (others == 0) return;
  throw Error(
      fmt::format("{}: expected only rows of numbers, because the files are joined row by row, found {} other {} "
                  "between the first and the last row.",
                  name, others, others == 1 ? "line" : "lines"));
}

// Adds the columns of `beside` to the log. `name` and `file`: theirs, for messages. Throws Error where either has lines
// without a row of numbers, or the numbers of rows differ by more than a tenth.
void join(Log& log, const std::string& name, Log beside, const std::string& file) {
  expect_rows_alone(log, name);
  expect_rows_alone(beside, file);
  Series& series = log.series;
  const std::size_t rows = series.time_s.size(), others = beside.series.time_s.size(), both = std::min(rows, others);
  if (both * 10 < std::max(rows, others) * 9) {
    throw Error(fmt::format("{}: expected about as many rows as in {}, {}, found {}.", file, name, rows, others));
  }
  if (rows != others) {
    const std::size_t more = std::max(rows, others) - both;
    log.remarks.push_back(fmt::format("{} rows here and {} in {}: the last {} omitted.", rows, others, file,
                                      more == 1 ? "row is" : fmt::format("{} rows are", more)));
  }
  log.recipe.columns.insert(log.recipe.columns.end(), beside.recipe.columns.begin(), beside.recipe.columns.end());
  std::set<std::string> taken;
  for (const Column& column : series.columns) taken.insert(column.name);
  std::size_t k = 0;
  for (LogColumn& column : beside.columns) {
    const bool is_time = !column.name.empty() && is_time_name(name_and_unit(column.source).name);
    if (is_time) {
      beside.series.columns.erase(beside.series.columns.begin() + static_cast<std::ptrdiff_t>(k));
      column.name.clear();
      column.why = "another time";
    }
    if (!column.name.empty()) {
      Column& values = beside.series.columns[k++];
      values.name = column.name = free_name(values.name, taken);
      series.columns.push_back(std::move(values));
    }
    log.columns.push_back(std::move(column));
  }
  series.time_s.resize(both);
  for (Column& column : series.columns) column.values.resize(both);
  log.remarks.push_back(
      fmt::format("Joined row by row: {} of {}.", k == 1 ? "1 column" : fmt::format("{} columns", k), file));
  std::move(beside.remarks.begin(), beside.remarks.end(), std::back_inserter(log.remarks));
}

void expect_joined_columns(const Log& log, const std::string& name, const LogRecipe& recipe) {
  Headers headers;
  for (const LogColumn& column : log.columns) headers.emplace_back(column.source, name_and_unit(column.source).name);
  expect_recipe_columns(headers, name, 1, recipe);
}

}  // namespace

constinit const Reader readers::kLog = {
    .found = "a log of columns over time",
    .is_yours =
        [](std::string_view head) {
          return is_table_file(head) || (!format_name(head).starts_with("ballbar") && holds_table(head));
        },
    .read = open_log,
};

void show_values(LogColumn& column, std::span<const double> values) {
  const std::span<const double> first = values.first(std::min(kShownRows, values.size()));
  column.first.assign(first.begin(), first.end());
  column.gaps =
      static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }));
}

Log read_log(std::string_view bytes, const std::string& name, const LogRecipe& recipe) {
  Source source = Source::of_text(name, std::string(bytes));
  source.set_recipe(std::make_shared<const LogRecipe>(recipe));
  return open_log(source);
}

Log open_log(const Source& source) {
  const LogRecipe& recipe = source.recipe();
  Log log = one_log(source, recipe, !recipe.join.empty());
  for (const std::string& file : recipe.join) join(log, source.name(), beside_of(log, source, file, recipe), file);
  if (!recipe.join.empty()) expect_joined_columns(log, source.name(), recipe);
  if (recipe.burst_means) {
    const std::size_t rows = log.series.time_s.size();
    take_burst_means(log.series, source.name());
    log.remarks.push_back(
        fmt::format("{} rows in {} bursts: each row is the mean of a burst.", rows, log.series.time_s.size()));
  }
  settle_targets(log);
  for (const auto& [column, values] : taken_columns(log)) show_values(*column, values->values);
  log.unclear = unclear_parts(log);
  source.close();
  return log;
}

WorkbookSheets sheets_of(const Source& source) {
  if (!is_table_file(source.head(512))) return {};
  return workbook_sheets(source.bytes(kLargestTable), source.name());
}

std::optional<double> seconds_of_stamp(std::string_view started) {
  const auto stamp = time_stamp(started, DateOrder::day_first);
  if (!stamp || !stamp->day || !stamp->clock_s) return std::nullopt;
  return static_cast<double>(*stamp->day) * 86400.0 + *stamp->clock_s;
}

std::string sentence_of(const Log& log) {
  std::array<std::size_t, 10> roles{};
  std::size_t left_out = 0, others = 0;
  for (const LogColumn& column : log.columns) {
    if (column.name.empty())
      ++left_out;
    else if (column.role == Role::event)
      ++others;
    else
      ++roles[static_cast<std::size_t>(column.role)];
  }
  std::string columns;
  const auto add = [&](std::size_t count, const std::string& one, const std::string& many) {
    if (count > 0) columns += fmt::format("{}{} {}", columns.empty() ? "" : ", ", count, count == 1 ? one : many);
  };
  const auto of = [&](Role role) { return roles[static_cast<std::size_t>(role)]; };
  add(of(Role::measured), "measured column", "measured columns");
  add(of(Role::speed), "speed", "speeds");
  add(of(Role::load), "load", "loads");
  add(of(Role::structure) + of(Role::housing) + of(Role::bearing) + of(Role::mean_point), "temperature",
      "temperatures");
  add(of(Role::ambient), "room temperature", "room temperatures");
  add(of(Role::coolant), "coolant temperature", "coolant temperatures");
  add(others, "other", "others");
  add(left_out, "left out", "left out");
  const std::string time =
      log.series.has_clock ? fmt::format("time {}", log.time) : "numbered, because no column holds the time";
  return fmt::format("read as {}; {} rows from line {}, {}; {}.", log.shape, log.series.time_s.size(),
                     log.first_row_line, time, columns);
}

}  // namespace ballbar
