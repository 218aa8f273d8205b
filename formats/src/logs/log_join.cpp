#include "logs/log_join.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/number_text.hpp"
#include "logs/log_plan.hpp"
#include "logs/log_units.hpp"

namespace ballbar {
namespace {

void expect_rows_alone(const Log& log, const std::string& name) {
  const std::size_t others = log.without_row + (log.series.has_clock ? log.skipped_lines.size() : 0);
  if (others == 0) return;
  throw Error(
      fmt::format("{}: expected only rows of numbers, because the files are joined row by row, found {} other {} "
                  "between the first and the last row.",
                  name, others, others == 1 ? "line" : "lines"));
}

}  // namespace

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

double stated_shift_s(const LogRecipe& recipe, const std::string& name) {
  double shift_s = 0.0;
  const std::string file = std::filesystem::path(name).filename().string();
  for (const LogShift& one : recipe.shifts) {
    if (suits(one.file, name) || suits(one.file, file)) shift_s += one.shift_s;
  }
  return shift_s;
}

std::string shift_clock(Series& series, const LogRecipe& recipe, const std::string& name) {
  const double shift_s = stated_shift_s(recipe, name);
  if (shift_s == 0.0) return {};
  if (!series.has_clock) throw Error(fmt::format("{}: expected a clock for --shift, found numbered rows.", name));
  if (const auto started_s = series.started ? seconds_of_stamp(*series.started) : std::nullopt) {
    series.started = stamp_text(*started_s + shift_s);
  } else {
    for (double& time_s : series.time_s) time_s += shift_s;
  }
  return fmt::format("Its clock is set {} {}, as --shift states.", duration_text(std::abs(shift_s)),
                     shift_s > 0.0 ? "later" : "earlier");
}

}  // namespace ballbar
