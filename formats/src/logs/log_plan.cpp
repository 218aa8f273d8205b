#include "logs/log_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/column_sample.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_channels.hpp"
#include "logs/log_roles.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "logs/time_finder.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

bool is_pattern(std::string_view text) { return text.find_first_of("*?") != std::string_view::npos; }

bool names_a_count(std::string_view name) {
  constexpr std::string_view kNames =
      "|no|nr|number|index|unnamed 0|sample|samples|row|id|#|n|scan|record|count|point|lfd nr|zeile|nummer|numero|"
      "序号|编号|番号|no.|messung|sample number|sample no|data no|reading|num|punkt|recnbr|rec|recno|rn";
  return is_one_of(kNames, folded(name));
}

void name_columns(const LogShape& shape, LogPlan& plan) {
  for (std::size_t i = 0; i < shape.headers.size(); ++i) {
    PlannedColumn column;
    column.source = shape.headers[i];
    const NameAndUnit split = name_and_unit(column.source);
    column.name = split.name;
    column.unit = split.unit;
    if (column.unit.empty() && !shape.units[i].empty() && shape.units[i] != "-") column.unit = shape.units[i];
    column.headed = !column.source.empty();
    if (column.source.empty()) column.source = column.name = fmt::format("c{}", i + 1);
    if (column.name.empty()) column.name = column.source;
    if (column.unit.empty() && folded(column.name) == "x value") column.unit = "s";  // LabVIEW's measurement files
    plan.columns.push_back(std::move(column));
  }
}

// "Minutes", "sec", "h": the header of the first column is the unit of a time. Where another column has a time it is
// not, nor beside "max" or "mean", nor are names that mean something else.
void take_unit_as_time(const std::vector<ColumnSample>& samples, LogPlan& plan) {
  PlannedColumn& first = plan.columns.front();
  if (!first.unit.empty() || !time_unit_s(first.name) || is_one_of("std|tag|d", folded(first.name))) return;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const std::string key = folded(plan.columns[i].name);
    const bool is_other = i > 0 && (time_unit_s(plan.columns[i].name) || is_time_name(key));
    if (is_other || samples[i].stamps + samples[i].dates + samples[i].clocks > 0) return;
    for (const std::string_view word : {"max", "mean", "avg", "mittel"}) {
      if (key.find(word) != std::string::npos) return;
    }
  }
  first.unit = first.name;
}

void take_stated(const LogRecipe& recipe, LogPlan& plan) {
  Headers headers;
  std::vector<std::string> units;
  for (const PlannedColumn& column : plan.columns) {
    headers.emplace_back(column.source, column.name);
    units.push_back(column.unit);
  }
  std::vector<StatedColumn> stated = stated_columns(recipe, headers, units);
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    plan.columns[i].stated = std::move(stated[i].column);
    plan.columns[i].unit_by_pattern = stated[i].unit_by_pattern;
  }
}

// The places of the columns that a user means by a name or a pattern.
class NamedPlaces {
 public:
  explicit NamedPlaces(const Headers& headers) : headers_(headers), comparables_(comparables_of(headers)) {}

  [[nodiscard]] std::vector<std::size_t> of(const std::string& typed) const {
    if (!is_pattern(typed)) return columns_named(typed, headers_, comparables_);
    std::vector<std::size_t> found;
    const std::string key = small(typed);
    for (std::size_t i = 0; i < headers_.size(); ++i) {
      const auto& [source, name] = headers_[i];
      const std::string_view before =
          trimmed_cell(std::string_view(source).substr(0, source.find_first_of("([")));  // without what is in brackets
      if (suits(key, small(source)) || suits(key, small(name)) || suits(key, small(before))) found.push_back(i);
    }
    return found;
  }

 private:
  const Headers& headers_;
  std::vector<ComparableName> comparables_;
};

// "Y_Unit_Label Volts Amps", one a channel, behind the column of X: LabVIEW's measurement files.
void label_units(const LogShape& shape, LogPlan& plan) {
  std::vector<std::string_view> cells;
  for (const HeadLine& line : shape.preamble) {
    split_cells(line.text, shape.delimiter, cells);
    if (cells.size() < 2 || trimmed_cell(cells.front()) != "Y_Unit_Label") continue;
    for (std::size_t i = 1; i < std::min(cells.size(), plan.columns.size()); ++i) {
      if (plan.columns[i].unit.empty()) plan.columns[i].unit = std::string(trimmed_cell(cells[i]));
    }
  }
}

// Below "CH;Signal name;Input" the preamble says what is connected: "CH1;Front bearing;TEMP" (Graphtec).
void name_channels(const LogShape& shape, LogPlan& plan) {
  std::vector<std::string_view> cells;
  bool below = false;
  for (const HeadLine& line : shape.preamble) {
    split_cells(line.text, shape.delimiter, cells);
    if (cells.size() < 2) continue;
    const std::string_view first = trimmed_cell(cells[0]), second = trimmed_cell(cells[1]);
    below = below || (first == "CH" && folded(second).find("name") != std::string::npos);
    if (!below || second.empty()) continue;
    for (PlannedColumn& column : plan.columns) {
      if (column.name == first) column.name = fmt::format("{} {}", first, second);
    }
  }
}

// A second clock beside the stamps: one that runs as long. Beside a number, any.
bool runs_as_the_time(const std::vector<ColumnSample>& samples, const LogPlan& plan, std::size_t i) {
  const ColumnSample& time = samples[plan.time.column];
  if (plan.time.kind != TimePlan::Kind::stamps || !time.first_s) return true;
  return runs_as_long(samples[i], *time_unit_s(plan.columns[i].unit), time);
}

// Two logs side by side: numbers, another time that goes by differently from row to row, and more numbers.
void expect_one_time(const LogShape& shape, const std::string& name, const std::vector<ColumnSample>& samples,
                     LogPlan& plan) {
  const TimePlan& time = plan.time;
  if (time.kind == TimePlan::Kind::rows) return;
  const auto is_value = [](const PlannedColumn& column) { return column.kind == ColumnKind::number && column.headed; };
  const auto step_s = [&](std::size_t i, double unit_s) {
    const ColumnSample& sample = samples[i];
    const double all_s = sample.values.size() > 1 ? unit_s * (sample.values.back() - sample.values.front())
                         : sample.first_s         ? *sample.last_s - *sample.first_s
                                                  : 0.0;
    return all_s / static_cast<double>(std::max<std::size_t>(2, sample.written()) - 1);
  };
  const double usual_s = step_s(time.column, time.unit_s);
  for (std::size_t i = time.column + 2; i + 1 < plan.columns.size(); ++i) {
    PlannedColumn& column = plan.columns[i];
    const auto unit_s = time_unit_s(column.unit);
    const bool is_number = samples[i].values.size() > 1 && unit_s && samples[i].rises && is_value(column);
    const auto at = plan.columns.begin() + static_cast<std::ptrdiff_t>(i);
    if (column.stated.left_out || !(is_number || column.why == "another time") || !is_value(*(at + 1)) ||
        std::none_of(plan.columns.begin() + static_cast<std::ptrdiff_t>(time.column) + 1, at, is_value))
      continue;
    const double other_s = step_s(i, unit_s.value_or(1.0));
    if (!(other_s > 0.0 && usual_s > 0.0) || std::abs(other_s / usual_s - 1.0) < 0.02) continue;
    throw Error(fmt::format(
        "{}:{}: expected one time for all columns, found another, {}, which goes on by {:.6g} s a row where "
        "{} goes on by {:.6g} s. Write the columns from there on into a file of their own, or use "
        "--leave-out {}.",
        name, shape.first_row_line, in_quotes(column.source), other_s, in_quotes(plan.columns[time.column].source),
        usual_s, in_quotes(column.source)));
  }
}

constexpr std::string_view kInchMark = "\"";

// What stands before and behind the number of each cell: "S" of a programmed speed, "S4800", the unit of "23.4 °C", or
// the name of "bearing=23.4".
std::optional<std::pair<std::string, std::string>> signs_about_numbers(const std::set<std::string>& words) {
  std::optional<std::pair<std::string, std::string>> signs;
  for (const std::string& word : words) {
    const std::string_view cell = trimmed_cell(word);
    if (switch_value(cell) == 0.0) continue;  // of a speed, "stop"
    const std::size_t begin = cell.find_first_of("0123456789");
    if (begin == std::string_view::npos) return std::nullopt;
    const std::size_t end = std::min(cell.find_first_not_of("0123456789.,", begin), cell.size());
    std::string_view before = cell.substr(0, begin);
    if (before.ends_with('-') || before.ends_with('+')) before.remove_suffix(1);
    before = trimmed_cell(before);
    const std::string_view behind = trimmed_cell(cell.substr(end));
    if (!signs) signs.emplace(before, behind);
    if (before != signs->first || behind != signs->second) return std::nullopt;
  }
  const bool is_unit = signs && signs->first.empty() && (signs->second == kInchMark || log_unit(signs->second));
  // N10 is a line of a program, S1 a state.
  const bool is_speed =
      signs && signs->first == "S" && signs->second.empty() &&
      std::any_of(words.begin(), words.end(), [](const std::string& word) { return trimmed_cell(word).size() > 3; });
  const bool is_named = signs && signs->first.ends_with('=');
  return is_unit || is_speed || is_named ? signs : std::nullopt;
}

// A column of texts: another time, numbers with a sign in each cell, or words.
void plan_text(const ColumnSample& sample, PlannedColumn& column) {
  column.why = sample.mostly(sample.stamps + sample.dates + sample.clocks) ? "another time" : "text";
  if (sample.stamps + sample.dates + sample.clocks > 0) return;
  const auto signs = sample.numbers == 0 ? signs_about_numbers(sample.words) : std::nullopt;
  if (!signs) {
    if (sample.numbers == 0 && column.headed) column.kind = ColumnKind::words;
    return;
  }
  column.kind = ColumnKind::number;
  std::tie(column.before, column.behind) = *signs;
  if (column.before.size() > 1 && !column.headed) {
    column.source = column.before.substr(0, column.before.size() - 1);
    const NameAndUnit both = name_and_unit(column.source);
    column.name = both.name;
    column.unit = both.unit;
    column.headed = true;
  }
  if (column.unit.empty() && (column.before.size() < 2 || !column.behind.empty()))
    column.unit = column.behind.empty() ? "rpm" : column.behind == kInchMark ? "in" : column.behind;
}

// The columns other than the time: numbers, or why not.
void plan_values(const std::vector<bool>& is_label, const std::vector<ColumnSample>& samples, const LogRecipe& recipe,
                 LogPlan& plan) {
  const bool counted = plan.time.kind != TimePlan::Kind::rows || recipe.every_s || plan.time.numbered;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    PlannedColumn& column = plan.columns[i];
    if (column.kind != ColumnKind::left_out) continue;
    const ColumnSample& sample = samples[i];
    if (is_label[i]) {
      column.kind = ColumnKind::label;
    } else if (column.stated.left_out) {
      column.why = "left out by the recipe";
    } else if (!column.stated.unit.empty() && !column.unit_by_pattern && sample.numbers > 0) {
      column.kind = ColumnKind::number;
      column.unit = column.stated.unit;
    } else if (sample.is_switch()) {
      column.kind = ColumnKind::number;
      column.is_switch = true;
    } else if (sample.written() == 0) {
      const bool headed = column.headed;
      column.kind = headed ? ColumnKind::number : ColumnKind::left_out;  // empty: of a separator at the end of the line
      if (!headed) column.why = "empty";
    } else if (!sample.mostly(sample.numbers) || sample.stamps > 0) {
      plan_text(sample, column);
    } else if (counts_rows(sample, !column.headed) && (!column.headed || names_a_count(column.name)) &&
               (counted || i == 0)) {
      column.why = "counts the rows";
    } else if (time_unit_s(column.unit) && sample.rises && sample.ever_rises &&
               (is_time_name(column.name) || folded(column.name).starts_with("time")) &&
               runs_as_the_time(samples, plan, i)) {
      column.why = "another time";
    } else {
      column.kind = ColumnKind::number;
    }
    const auto unit = log_unit(column.unit);
    column.is_speed = names_a_speed(column.name) || (unit && unit->canonical == "rpm");
  }
}

}  // namespace

bool is_time(const LogPlan& plan, std::size_t column) {
  return plan.time.kind == TimePlan::Kind::number && column == plan.time.column;
}

bool suits(std::string_view pattern, std::string_view text) {
  std::size_t at = 0, in_text = 0, star = std::string_view::npos, from = 0;
  while (in_text < text.size()) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      from = in_text;
    } else if (at < pattern.size() && (pattern[at] == '?' || pattern[at] == text[in_text])) {
      ++at;
      ++in_text;
    } else if (star != std::string_view::npos) {
      at = star + 1;
      in_text = ++from;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == std::string_view::npos;
}

std::vector<StatedColumn> stated_columns(const LogRecipe& recipe, const Headers& headers,
                                         const std::vector<std::string>& units) {
  std::vector<StatedColumn> stated(headers.size());
  if (recipe.columns.empty()) return stated;
  const NamedPlaces places(headers);
  for (const bool patterns : {true, false}) {
    for (const ColumnRecipe& one : recipe.columns) {
      if (is_pattern(one.source) != patterns) continue;
      for (const std::size_t i : places.of(one.source)) {
        ColumnRecipe& column = stated[i].column;
        column.source = headers[i].first;
        if (!one.name.empty()) column.name = one.name;
        if (!one.unit.empty() && (units[i].empty() || !(patterns || recipe.may_lack_columns))) {
          column.unit = one.unit;
          stated[i].unit_by_pattern = patterns;
        }
        if (one.role) column.role = one.role;
        column.left_out = column.left_out || one.left_out;
      }
    }
  }
  return stated;
}

void expect_recipe_columns(const Headers& headers, const std::string& name, std::size_t line, const LogRecipe& recipe) {
  if (recipe.may_lack_columns) return;
  const NamedPlaces places(headers);
  for (const ColumnRecipe& one : recipe.columns) {
    const std::vector<std::size_t> found = places.of(one.source);
    const auto is_first = [&](std::size_t i) { return headers[i].first == headers[found.front()].first; };
    if (!found.empty() && (is_pattern(one.source) || std::all_of(found.begin(), found.end(), is_first))) continue;
    if (!found.empty()) {
      std::vector<std::string> several;
      several.reserve(found.size());
      for (const std::size_t i : found) several.push_back(in_quotes(headers[i].first));
      throw Error(fmt::format("{}:{}: expected the name of one column, found {}, which may be {}; state its unit too.",
                              name, line, in_quotes(one.source), fmt::join(several, " or ")));
    }
    std::vector<std::string_view> known;
    known.reserve(headers.size());
    for (const auto& header : headers) known.emplace_back(header.first);
    throw Error(fmt::format(
        "{}:{}: expected a column {}, as stated by the options or the recipe, found none; the nearest is {}.", name,
        line, in_quotes(one.source), in_quotes(nearest_name(one.source, known))));
  }
}

LogPlan log_plan(const LogShape& shape, const std::string& name, const LogRecipe& recipe) {
  LogPlan plan;
  name_columns(shape, plan);
  label_units(shape, plan);
  name_channels(shape, plan);
  take_stated(recipe, plan);
  const std::vector<ColumnSample> samples = samples_of(shape);
  take_unit_as_time(samples, plan);
  find_time(shape, name, recipe, samples, plan);
  plan_values(shape.is_label, samples, recipe, plan);
  find_channel_names(shape, samples, plan);
  expect_one_time(shape, name, samples, plan);
  bool any = false;
  for (std::size_t i = 0; i < plan.columns.size(); ++i)
    any = any || (plan.columns[i].kind == ColumnKind::number && !is_time(plan, i));
  if (!any) {
    throw Error(
        fmt::format("{}:{}: expected a column of numbers besides the time, found none.", name, shape.first_row_line));
  }
  return plan;
}

}  // namespace ballbar
