#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/series/series.hpp"
#include "series/pause.hpp"

namespace ballbar {
namespace {

std::string_view stem_of(std::string_view column) {
  const std::string_view unit = unit_of(column);
  return unit.empty() ? column : column.substr(0, column.size() - unit.size() - 1);
}

bool is_in_all(const std::vector<Series>& runs, const std::string& column) {
  return std::all_of(runs.begin(), runs.end(), [&](const Series& run) { return find_column(run, column) != nullptr; });
}

// A column of one run that another has in other units.
void expect_same_units(const std::vector<Series>& runs, const std::vector<std::string>& names) {
  for (std::size_t r = 1; r < runs.size(); ++r) {
    for (const Column& column : runs[r].columns) {
      if (find_column(runs.front(), column.name) != nullptr || unit_of(column.name).empty()) continue;
      for (const Column& other : runs.front().columns) {
        if (unit_of(other.name).empty() || stem_of(other.name) != stem_of(column.name)) continue;
        throw Error(fmt::format("expected the columns of all runs in the same units, found {} in {} and {} in {}.",
                                other.name, names.front(), column.name, names[r]));
      }
    }
  }
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// The same rows: times since the first and values of every column.
bool same_rows(const Series& a, const Series& b) {
  if (a.time_s.size() != b.time_s.size()) return false;
  std::size_t compared = 0;
  for (const Column& column : a.columns) {
    const Column* other = find_column(b, column.name);
    if (other == nullptr) continue;
    ++compared;
    if (!std::equal(column.values.begin(), column.values.end(), other->values.begin(), same)) return false;
  }
  return compared > 0;
}

struct Hours {
  std::optional<double> begin_s, end_s;
};

std::vector<Hours> hours_of(const std::vector<Series>& runs, const std::vector<std::optional<double>>& zeros_s) {
  std::vector<Hours> hours(runs.size());
  for (std::size_t r = 0; r < zeros_s.size(); ++r) {
    if (zeros_s[r]) hours[r] = {*zeros_s[r] + runs[r].time_s.front(), *zeros_s[r] + runs[r].time_s.back()};
  }
  return hours;
}

void expect_separate(const std::vector<Series>& runs, const std::vector<std::string>& names,
                     const std::vector<Hours>& hours) {
  for (std::size_t a = 0; a < runs.size(); ++a) {
    for (std::size_t b = a + 1; b < runs.size(); ++b) {
      if (same_rows(runs[a], runs[b])) {
        throw Error(fmt::format("expected every run once, found the same rows in {} and {}.", names[a], names[b]));
      }
      if (!hours[a].begin_s || !hours[b].begin_s) continue;
      if (*hours[a].begin_s > *hours[b].end_s || *hours[b].begin_s > *hours[a].end_s) continue;
      throw Error(
          fmt::format("expected runs of one machine one after another, found {} and {}, which overlap by their "
                      "clocks; where they are two logs of one run, `ballbar import` makes one of them.",
                      names[a], names[b]));
    }
  }
}

bool begins_warm(const Series& run, std::size_t number, const std::vector<Hours>& hours) {
  if (hours[number].begin_s) {
    for (std::size_t other = 0; other < hours.size(); ++other) {
      if (other == number || !hours[other].end_s) continue;
      const double rest_s = *hours[number].begin_s - *hours[other].end_s;
      if (rest_s > 0.0 && rest_s < kRest_s) return true;
    }
  }
  return std::any_of(run.columns.begin(), run.columns.end(), [](const Column& column) {
    return column.role == Role::speed && !column.values.empty() && std::abs(column.values.front()) > 0.0;
  });
}

}  // namespace

void add_unread(const Series& part, Series& all) {
  for (const std::string& column : part.unread) {
    if (std::find(all.unread.begin(), all.unread.end(), column) == all.unread.end()) all.unread.push_back(column);
  }
}

std::vector<RowRange> runs_of(std::span<const double> time_s) {
  std::vector<RowRange> ranges;
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    if (row == 0 || time_s[row] < time_s[row - 1]) ranges.push_back({row, row});
    ranges.back().end = row + 1;
  }
  return ranges;
}

Series rows_of(const Series& data, const RowRange& range) {
  const auto part = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(range.begin),
                               values.begin() + static_cast<std::ptrdiff_t>(range.end));
  };
  Series result;
  result.time_s = part(data.time_s);
  result.five_probe = data.five_probe;
  result.has_clock = data.has_clock;
  result.unread = data.unread;
  std::copy_if(data.sensor_jumps.begin(), data.sensor_jumps.end(), std::back_inserter(result.sensor_jumps),
               [&](const SensorJump& jump) {
                 return data.runs.empty() && !result.time_s.empty() && jump.time_s >= result.time_s.front() &&
                        jump.time_s <= result.time_s.back();
               });
  result.columns.reserve(data.columns.size());
  for (const Column& column : data.columns)
    result.columns.push_back({column.name, column.role, part(column.values), column.header});
  return result;
}

std::vector<double> one_after_another(std::span<const double> time_s) {
  std::vector<double> result(time_s.begin(), time_s.end());
  double offset_s = 0.0;
  for (std::size_t row = 1; row < result.size(); ++row) {
    if (time_s[row] < time_s[row - 1]) {
      const double step_s = row > 1 && time_s[row - 1] > time_s[row - 2] ? time_s[row - 1] - time_s[row - 2] : 1.0;
      offset_s = result[row - 1] + step_s - time_s[row];
    }
    result[row] = time_s[row] + offset_s;
  }
  return result;
}

Stacked stacked(const std::vector<Series>& runs, const std::vector<std::string>& names,
                const std::vector<std::optional<double>>& zeros_s) {
  Stacked result;
  if (runs.size() == 1) {
    result.series = runs.front();
    return result;
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (runs[r].time_s.size() >= 2) continue;
    throw Error(fmt::format("{}: expected a run of at least 2 rows, found {}.", names[r], runs[r].time_s.size()));
  }
  expect_same_units(runs, names);
  if (!zeros_s.empty() && zeros_s.size() != runs.size()) {
    throw Error(fmt::format("expected a start of each of {} runs, found {}.", runs.size(), zeros_s.size()));
  }
  const std::vector<Hours> hours = hours_of(runs, zeros_s);
  expect_separate(runs, names, hours);
  Series& all = result.series;
  all.five_probe = runs.front().five_probe;
  all.has_clock = std::all_of(runs.begin(), runs.end(), [](const Series& run) { return run.has_clock; });
  for (const Series& run : runs) add_unread(run, all);
  std::vector<std::string> left_out;
  for (const Series& run : runs) {
    for (const Column& column : run.columns) {
      const bool is_known = std::find(left_out.begin(), left_out.end(), column.name) != left_out.end();
      if (!is_in_all(runs, column.name) && !is_known) left_out.push_back(column.name);
    }
  }
  for (const Column& column : runs.front().columns) {
    if (is_in_all(runs, column.name)) all.columns.push_back({column.name, column.role, {}, column.header});
  }
  if (all.columns.empty())
    throw Error(fmt::format("expected a column that all of {} have, found none.", fmt::join(names, ", ")));
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Series& run = runs[r];
    for (const double time_s : run.time_s) all.time_s.push_back(time_s - run.time_s.front());
    for (Column& column : all.columns) {
      const std::vector<double>& values = find_column(run, column.name)->values;
      column.values.insert(column.values.end(), values.begin(), values.end());
    }
    for (const SensorJump& jump : run.sensor_jumps)
      all.sensor_jumps.push_back({jump.column, names[r], jump.time_s - run.time_s.front(), jump.size});
    all.runs.push_back({names[r], begins_warm(run, r, hours) ? RunStart::warm : RunStart::rest});
  }
  if (!left_out.empty()) {
    result.remarks.push_back(fmt::format("left out, as not all runs have {}: {}", left_out.size() == 1 ? "it" : "them",
                                         fmt::join(left_out, ", ")));
  }
  return result;
}

}  // namespace ballbar
