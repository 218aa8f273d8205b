#include "ballbar/series/merged_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <span>

#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

bool is_signal(const Column& column) { return column.role != Role::measured && column.role != Role::event; }

// The rows of a column that have a value.
struct Known {
  std::vector<double> time_s, value;
};

Known known(const Series& part, const Column& column) {
  Known result;
  for (std::size_t row = 0; row < part.time_s.size(); ++row) {
    if (std::isnan(column.values[row])) continue;
    result.time_s.push_back(part.time_s[row]);
    result.value.push_back(column.values[row]);
  }
  return result;
}

// "6.67": to 0.01 min.
std::string min_text(double time_s) { return fmt::format("{:.10g}", std::round(100.0 * min_from_s(time_s)) / 100.0); }

struct Range {
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();
  bool has(double time_s) const { return time_s >= from_s && time_s <= to_s; }
};

void expect_different_names(std::span<const Series> parts) {
  std::set<std::string> names;
  for (const Series& part : parts) {
    for (const Column& column : part.columns) {
      if (names.insert(column.name).second) continue;
      throw Error(fmt::format("expected every column once, found {} twice.", column.name));
    }
  }
}

Range covered(std::span<const Series> parts) {
  Range range;
  for (const Series& part : parts) {
    for (const Column& column : part.columns) {
      if (!is_signal(column)) continue;
      const Known values = known(part, column);
      if (values.value.empty()) throw Error(fmt::format("expected values of {}, found none.", column.name));
      range.from_s = std::max(range.from_s, values.time_s.front());
      range.to_s = std::min(range.to_s, values.time_s.back());
    }
  }
  return range;
}

void expect_no_gap(const std::string& name, const Known& values, const Range& range, double max_gap_s) {
  for (std::size_t i = 1; i < values.time_s.size(); ++i) {
    const double before_s = values.time_s[i - 1], after_s = values.time_s[i];
    if (after_s - before_s <= max_gap_s || after_s <= range.from_s || before_s >= range.to_s) continue;
    const bool in_s = max_gap_s < 120.0;
    const auto text = [&](double time_s) { return in_s ? fmt::format("{:.10g}", time_s) : min_text(time_s); };
    throw Error(fmt::format("expected values of {0} at most {1} {4} apart, found none between {2} and {3} {4}.", name,
                            text(max_gap_s), text(before_s), text(after_s), in_s ? "s" : "min"));
  }
}

std::string times_of(const Series& part) {
  const std::string name = part.columns.empty() ? "a part without columns" : part.columns.front().name;
  if (part.time_s.empty()) return fmt::format("{} at no time", name);
  return fmt::format("{} from {} to {} min", name, min_text(part.time_s.front()), min_text(part.time_s.back()));
}

void expect_common_times(std::span<const Series> parts, const Range& range) {
  for (const Series& part : parts) {
    if (std::any_of(part.time_s.begin(), part.time_s.end(), [&](double time_s) { return range.has(time_s); })) continue;
    if (range.from_s > range.to_s) {
      std::string found;
      for (const Series& each : parts) found += (found.empty() ? "" : ", ") + times_of(each);
      throw Error(fmt::format("expected times in common, found {}.", found));
    }
    throw Error(fmt::format("expected times in common, found {} and signals from {} to {} min.", times_of(part),
                            min_text(range.from_s), min_text(range.to_s)));
  }
}

std::vector<double> on(const std::vector<double>& time_s, const Known& values, Role role) {
  std::vector<double> result(time_s.size(), kUnknown);
  std::size_t next = 0;  // first known value after the row
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    while (next < values.time_s.size() && values.time_s[next] <= time_s[row]) ++next;
    if (next == 0) continue;
    const std::size_t last = next - 1;
    if (values.time_s[last] == time_s[row] || role == Role::event) {
      result[row] = values.value[last];
    } else if (role != Role::measured && next < values.time_s.size()) {
      const double share = (time_s[row] - values.time_s[last]) / (values.time_s[next] - values.time_s[last]);
      result[row] = value_at(values.value, {last, share});
    }
  }
  return result;
}

Series merged_parts(std::span<const Series> parts, double max_gap_s) {
  expect_different_names(parts);
  const Range range = covered(parts);
  expect_common_times(parts, range);
  Series result;
  for (const Series& part : parts) {
    std::copy_if(part.time_s.begin(), part.time_s.end(), std::back_inserter(result.time_s),
                 [&](double time_s) { return range.has(time_s); });
    if (!result.five_probe) result.five_probe = part.five_probe;
    result.has_clock = result.has_clock && part.has_clock;
  }
  std::sort(result.time_s.begin(), result.time_s.end());
  result.time_s.erase(std::unique(result.time_s.begin(), result.time_s.end()), result.time_s.end());
  for (const Series& part : parts) {
    for (const Column& column : part.columns) {
      const Known values = known(part, column);
      if (is_signal(column)) expect_no_gap(column.name, values, range, max_gap_s);
      result.columns.push_back({column.name, column.role, on(result.time_s, values, column.role)});
    }
  }
  return result;
}

}  // namespace

Series merged(const std::vector<Series>& parts, double max_gap_s) { return merged_parts(parts, max_gap_s); }

std::shared_ptr<const Series> with_gaps_closed(std::shared_ptr<const Series> series, double max_gap_s) {
  const auto has_gap = [](const Column& column) {
    return column.role != Role::measured &&
           std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isnan(value); });
  };
  const std::vector<double>& time_s = series->time_s;
  const bool is_dense = std::adjacent_find(time_s.begin(), time_s.end(), [&](double before_s, double after_s) {
                          return after_s - before_s > max_gap_s;
                        }) == time_s.end();
  if (is_dense && !time_s.empty() && std::none_of(series->columns.begin(), series->columns.end(), has_gap)) {
    expect_different_names({series.get(), 1});
    return series;
  }
  Series closed = merged_parts({series.get(), 1}, max_gap_s);
  closed.started = series->started;
  return std::make_shared<const Series>(std::move(closed));
}

}  // namespace ballbar
