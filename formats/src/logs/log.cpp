#include "ballbar/formats/logs/log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_channels.hpp"
#include "logs/log_clock.hpp"
#include "logs/log_columns.hpp"
#include "logs/log_join.hpp"
#include "logs/log_plan.hpp"
#include "logs/log_roles.hpp"
#include "logs/log_shape.hpp"
#include "logs/log_sources.hpp"
#include "logs/log_table.hpp"
#include "logs/log_temperatures.hpp"
#include "logs/log_units.hpp"
#include "logs/missing_values.hpp"
#include "logs/text_fold.hpp"
#include "text/cells.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kListedLines = 10;    // of those that are skipped
constexpr std::size_t kListedColumns = 5;   // that are left out
constexpr std::size_t kProbesAtMost = 3;    // that no name tells
constexpr std::size_t kColumnsOfRows = 10;  // times the rows: it lies on its side
constexpr double kBetweenBursts = 5.0;      // times the middle step of time

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

// Rows of another table above this one: its names, or their number, change where this one begins.
void say_table_above(const LogShape& shape, Log& log) {
  constexpr std::size_t kFewestRows = 10;
  std::vector<std::string_view> cells;
  std::size_t rows = 0, first = 0;
  for (const HeadLine& line : shape.preamble) {
    split_cells(line.text, shape.delimiter, cells);
    const auto numbers = std::count_if(cells.begin(), cells.end(), [](std::string_view cell) {
      return look_of(trimmed_cell(cell)).kind != NumberLook::Kind::other;
    });
    if (cells.size() < 2 || 2 * static_cast<std::size_t>(numbers) < cells.size()) continue;
    if (rows++ == 0) first = line.number;
  }
  if (rows < kFewestRows) return;
  log.remarks.push_back(
      fmt::format("{} rows from line {} on are of another table and are not read, because its columns end before line "
                  "{}. Split the "
                  "file to read them.",
                  rows, first, shape.first_row_line));
}

void say_lines(const LogTable& table, const TimePlan& time, Log& log) {
  if (!time.likely.empty())
    log.remarks.push_back(
        fmt::format("{0} rises like a time. State --time {0} --time-unit s if it is one in s.", time.likely));
  if (time.two_fields_are_hours && table.elapsed && !table.first_day)
    log.remarks.push_back(
        fmt::format("{} is read as hours and minutes. State --time-unit min where 5:10 is five minutes.", time.text));
  const auto lines = [](std::size_t count) { return fmt::format("{} {}", count, count == 1 ? "line" : "lines"); };
  if (table.other_lines > 0)
    log.remarks.push_back(
        fmt::format("{} of comments, names or text after the rows: ignored.", lines(table.other_lines)));
  if (!table.gap_words.empty()) {
    std::vector<std::string> words;
    for (const std::string& word : table.gap_words) words.push_back(in_quotes(word));
    log.remarks.push_back(
        fmt::format("{}: read as a missing value wherever it stands for a number.", fmt::join(words, ", ")));
  }
  if (table.without_time > 0)
    log.remarks.push_back(fmt::format("{} without a time: left out.", lines(table.without_time)));
  if (table.before_clock > 0) {
    log.remarks.push_back(fmt::format("The first {} were written before the clock was set: left out.",
                                      table.before_clock == 1 ? "row" : fmt::format("{} rows", table.before_clock)));
  }
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

// What a user should state, because the file does not.
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

// c1, c2 ...: the log has no name for it.
bool is_nameless(const LogColumn& column) {
  return column.source.starts_with('c') && column.source.size() > 1 &&
         std::all_of(column.source.begin() + 1, column.source.end(), is_digit);
}

// A bare X, Y or Z without a unit is the place of an axis where another column is measured in one. Where none is, the
// columns that may be lengths are measured, if they are three at most and far from zero, as "mcu_pos_z". In a log
// without names the last column is measured, unless it is a temperature.
void settle_targets(Log& log) {
  const auto taken = taken_columns(log);
  using Taken = std::pair<LogColumn*, Column*>;
  const auto has_unit = [](const LogColumn& column) { return !column.unit.empty() || !column.found_unit.empty(); };
  const auto is_axis = [&](const LogColumn& column) {
    return !column.role_is_stated && !has_unit(column) && names_an_axis(column.source);
  };
  const bool any = std::any_of(taken.begin(), taken.end(), [&](const Taken& one) {
    return one.first->role == Role::measured && !one.first->unit.empty() && !is_axis(*one.first);
  });
  const auto set = [](const Taken& one, Role role, std::string_view why) {
    one.first->role = one.second->role = role;
    one.first->why = why;
  };
  for (const Taken& one : taken) {
    if (any && one.first->role == Role::measured && is_axis(*one.first))
      set(one, Role::event, "an axis position, by its name");
  }
  const auto is_measured = [](const Taken& one) { return one.first->role == Role::measured; };
  const auto is_coordinate = [](const Taken& one) { return names_an_axis(name_and_unit(one.first->source).name); };
  if (std::any_of(taken.begin(), taken.end(),
                  [&](const Taken& one) { return is_measured(one) && is_coordinate(one); })) {
    for (const Taken& one : taken) {
      if (one.first->why == kFarFromZero && is_coordinate(one)) set(one, Role::measured, "beside other coordinates");
    }
  }
  if (std::any_of(taken.begin(), taken.end(), is_measured)) return;
  const auto is_open = [](const Taken& one) {
    const Extremes range = extremes_of(one.second->values);
    return one.first->role == Role::event && !one.first->role_is_stated && range.most > range.least &&
           !is_switch(one.second->values);
  };
  const auto propose = [&](auto suits, std::string_view why) {
    std::vector<Taken> found;
    std::copy_if(taken.begin(), taken.end(), std::back_inserter(found),
                 [&](const Taken& one) { return is_open(one) && suits(*one.first); });
    if (found.empty() || found.size() > kProbesAtMost) return false;
    for (const Taken& one : found) set(one, Role::measured, why);
    return true;
  };
  const bool found =
      propose([](const LogColumn& column) { return column.why == kFarFromZero; }, "the only length; far from zero") ||
      propose([&](const LogColumn& column) { return !has_unit(column) && could_be_measured(column.source); },
              "the only possible measured column, in which unit?");
  if (!found && !taken.empty() && is_open(taken.back()) &&
      std::all_of(taken.begin(), taken.end(), [](const Taken& one) { return is_nameless(*one.first); }))
    set(taken.back(), Role::measured, "the last of the columns without names, in which unit?");
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

// Columns of words: two that take turns, or one and nothing, are a switch; more are states that nothing reads.
void take_words(LogTable& table, LogPlan& plan, Log& log) {
  constexpr std::size_t kFewestRows = 10;  // of each word, about
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    PlannedColumn& column = plan.columns[i];
    std::vector<double>& values = table.values[i];
    // Of numbers 1 alone: nothing stands where it is off.
    const bool is_one = column.kind == ColumnKind::number && column.headed && !is_time(plan, i) &&
                        std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v) || v == 1.0; });
    if (column.kind != ColumnKind::words && !is_one) continue;
    if (!is_one) column.kind = ColumnKind::left_out;
    if (values.size() != table.rows) continue;  // of channels below each other
    const std::vector<std::string> words = is_one ? std::vector<std::string>{"1"} : table.words[i];
    const auto is_gap = [](double value) { return std::isnan(value); };
    const auto gaps = static_cast<std::size_t>(std::count_if(values.begin(), values.end(), is_gap));
    const std::size_t written = values.size() - gaps;
    if (written < kFewestRows) continue;
    if (words.size() == 1 && gaps > 0) {
      for (double& value : values) value = is_gap(value) ? 0.0 : 1.0;
      log.remarks.push_back(
          fmt::format("{}: {} is read as 1, an empty cell as 0.", column.source, in_quotes(words.front())));
    } else if (words.size() == 2 && gaps == 0) {
      log.remarks.push_back(fmt::format("{}: {} is read as 0, {} as 1.", column.source, in_quotes(words.front()),
                                        in_quotes(words.back())));
    } else {
      if (words.size() > 1 && words.size() < kMostStates && written >= words.size() * kFewestRows)
        log.series.unread.push_back(column.source);
      continue;
    }
    column.kind = ColumnKind::number;
    column.is_switch = true;
  }
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
  LogTable table = side_by_side(log_table(source, shape, plan, recipe), name, plan);
  if (table.rows < 2) {
    throw Error(fmt::format("{}:{}: expected at least two rows, found {}.", name, shape.first_row_line, table.rows));
  }
  if (plan.columns.size() > kColumnsOfRows * table.rows &&
      std::none_of(plan.columns.begin(), plan.columns.end(), [](const auto& column) { return column.headed; })) {
    throw Error(
        fmt::format("{}:{}: expected a row for each time, found {} rows of {} values without names. If each row "
                    "is a channel, export one column a channel.",
                    name, shape.first_row_line, table.rows, plan.columns.size()));
  }
  Log log;
  log.shape = shape_text(shape);
  log.time = plan.time.text;
  log.first_row_line = table.before_clock > 0 ? table.line_of(0) : shape.first_row_line;
  log.names_from = shape.names_from;
  say_table_above(shape, log);
  say_lines(table, plan.time, log);
  log.skipped_lines = table.bad_lines;
  log.without_row = table.without_row;
  std::optional<double> started_s;
  log.series.time_s = clock_s(table, plan, name, started_s, log.remarks);
  log.series.has_clock = !plan.time.numbered;
  if (started_s) log.series.started = stamp_text(*started_s);
  take_words(table, plan, log);
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    if (plan.columns[i].kind != ColumnKind::number) continue;
    const auto say = [&](const std::string& gone) {
      if (!gone.empty())
        log.remarks.push_back(fmt::format("{}: {}: read as a missing value.", plan.columns[i].source, gone));
    };
    say(take_missing_values(table.values[i]));
    const auto unit = temperature_unit(plan.columns[i]);
    if (!unit) continue;
    say(take_failed_temperatures(table.values[i], unit->factor, unit->offset));
    say(take_repeated_numbers(table.values[i]));
    say(take_single_outliers(table.values[i]));
  }
  take_fahrenheit(plan, table.values);
  for (const auto& take_unit : {take_scale, take_mm}) {
    if (std::string assumed = take_unit(plan, table.values); !assumed.empty())
      log.remarks.push_back(std::move(assumed));
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
    const bool is_no_value = column.kind != ColumnKind::number && column.kind != ColumnKind::left_out;
    if (is_no_value || is_time(plan, i)) continue;
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
  if (std::string shifted = shift_clock(log.series, recipe, source.name()); !shifted.empty())
    log.remarks.push_back(std::move(shifted));
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
  std::size_t said = 0;
  for (const LogColumn& column : log.columns) {
    if (!column.name.empty() || said > kListedColumns) continue;
    columns +=
        said == kListedColumns ? " ..." : fmt::format("{}{} ({})", said == 0 ? ": " : ", ", column.source, column.why);
    ++said;
  }
  const std::string time =
      log.series.has_clock ? fmt::format("time {}", log.time) : "numbered, because no column holds the time";
  return fmt::format("read as {}; {} rows from line {}, {}{}{}; {}.", log.shape, log.series.time_s.size(),
                     log.first_row_line, log.names_from, log.names_from.empty() ? "" : ", ", time, columns);
}

}  // namespace ballbar
