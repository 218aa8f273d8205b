#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/series/signal_kind.hpp"
#include "ballbar/series/series.hpp"
#include "ballbar/units.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kLeastGap_s = 600.0;  // over which a temperature of a machine is a line
constexpr double kUsualSteps = 3.0;    // a reading or two may fail
constexpr double kLeastShare = 2.0 / 3.0;

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

double longest_gap_s(const Known& values, const std::optional<double>& max_gap_s) {
  return max_gap_s.value_or(std::max(kLeastGap_s, kUsualSteps * median_step_s(values.time_s)));
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

// Not a state, a tool's number, a count: of these, between two rows, one or the other holds.
bool is_smooth(const std::vector<double>& values) {
  return signal_kind(values) == SignalKind::smooth &&
         std::any_of(values.begin(), values.end(), [](double value) { return value != std::floor(value); });
}

// An event holds its last value; one that is smooth does so only where it may not be interpolated.
std::vector<double> on(const std::vector<double>& time_s, const Known& values, Role role, double max_gap_s) {
  const bool is_held = role == Role::event, is_line = !is_held || is_smooth(values.value);
  std::vector<double> result(time_s.size(), kUnknown);
  std::size_t next = 0;  // first known value after the row
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    while (next < values.time_s.size() && values.time_s[next] <= time_s[row]) ++next;
    if (next == 0) continue;
    const std::size_t last = next - 1;
    if (values.time_s[last] == time_s[row]) {
      result[row] = values.value[last];
    } else if (role == Role::measured) {
      continue;
    } else if (is_line && next < values.time_s.size() && values.time_s[next] - values.time_s[last] <= max_gap_s) {
      const double share = (time_s[row] - values.time_s[last]) / (values.time_s[next] - values.time_s[last]);
      result[row] = value_at(values.value, {last, share});
    } else if (is_held) {
      result[row] = values.value[last];
    }
  }
  return result;
}

// Where a signal has no value: it would have to be invented over a long gap.
struct Gaps {
  std::string signal;
  std::vector<std::size_t> rows;
  double max_gap_s = 0.0, first_from_s = 0.0, first_to_s = 0.0, longest_from_s = 0.0, longest_to_s = 0.0;
};

struct Parts {
  Series series;  // with the rows in the gaps
  std::vector<Gaps> gaps;
};

Gaps gaps_of(const std::string& name, const std::vector<double>& time_s, const std::vector<double>& on_rows,
             const Known& values, double max_gap_s) {
  Gaps gaps{.signal = name, .max_gap_s = max_gap_s};
  for (std::size_t row = 0; row < on_rows.size(); ++row) {
    if (std::isnan(on_rows[row])) gaps.rows.push_back(row);
  }
  if (gaps.rows.empty()) return gaps;
  const double first_s = time_s[gaps.rows.front()];
  const auto after = std::upper_bound(values.time_s.begin(), values.time_s.end(), first_s);
  gaps.first_from_s = *(after - 1);
  gaps.first_to_s = *after;
  for (const std::size_t row : gaps.rows) {
    const auto to = std::upper_bound(values.time_s.begin(), values.time_s.end(), time_s[row]);
    if (*to - *(to - 1) <= gaps.longest_to_s - gaps.longest_from_s) continue;
    gaps.longest_from_s = *(to - 1);
    gaps.longest_to_s = *to;
  }
  return gaps;
}

Parts parts_on_one_clock(std::span<const Series> parts, const std::optional<double>& max_gap_s) {
  expect_different_names(parts);
  const Range range = covered(parts);
  expect_common_times(parts, range);
  Parts result;
  Series& series = result.series;
  for (const Series& part : parts) {
    std::copy_if(part.time_s.begin(), part.time_s.end(), std::back_inserter(series.time_s),
                 [&](double time_s) { return range.has(time_s); });
    if (!series.five_probe) series.five_probe = part.five_probe;
    series.has_clock = series.has_clock && part.has_clock;
    add_unread(part, series);
  }
  std::sort(series.time_s.begin(), series.time_s.end());
  series.time_s.erase(std::unique(series.time_s.begin(), series.time_s.end()), series.time_s.end());
  for (const Series& part : parts) {
    for (const Column& column : part.columns) {
      const Known values = known(part, column);
      const double gap_s = longest_gap_s(values, max_gap_s);
      std::vector<double> on_rows = on(series.time_s, values, column.role, gap_s);
      if (is_signal(column)) {
        Gaps gaps = gaps_of(column.name, series.time_s, on_rows, values, gap_s);
        if (!gaps.rows.empty()) result.gaps.push_back(std::move(gaps));
      }
      series.columns.push_back({column.name, column.role, std::move(on_rows), column.header});
    }
  }
  return result;
}

std::vector<char> kept_rows(const Parts& parts) {
  std::vector<char> kept(parts.series.time_s.size(), 1);
  for (const Gaps& gaps : parts.gaps) {
    for (const std::size_t row : gaps.rows) kept[row] = 0;
  }
  return kept;
}

// Of the rows, and of those at which a column was measured.
bool keeps_enough(const Series& series, const std::vector<char>& kept) {
  const auto enough = [&](auto counts) {
    std::size_t all = 0, left = 0;
    for (std::size_t row = 0; row < kept.size(); ++row) {
      if (!counts(row)) continue;
      ++all;
      left += kept[row] != 0;
    }
    return static_cast<double>(left) >= kLeastShare * static_cast<double>(all);
  };
  return enough([](std::size_t) { return true; }) &&
         std::all_of(series.columns.begin(), series.columns.end(), [&](const Column& column) {
           return column.role != Role::measured ||
                  enough([&](std::size_t row) { return std::isfinite(column.values[row]); });
         });
}

void expect_enough(const Parts& parts, const std::vector<char>& kept) {
  if (keeps_enough(parts.series, kept)) return;
  const Gaps& gaps = *std::max_element(parts.gaps.begin(), parts.gaps.end(),
                                       [](const Gaps& a, const Gaps& b) { return a.rows.size() < b.rows.size(); });
  const bool in_s = gaps.max_gap_s < 120.0;
  const auto text = [&](double time_s) { return in_s ? fmt::format("{:.10g}", time_s) : min_text(time_s); };
  throw Error(fmt::format(
      "expected values of {0} at most {1} {4} apart, found none between {2} and {3} {4}. A longer "
      "--max-gap interpolates over it.",
      gaps.signal, text(gaps.max_gap_s), text(gaps.first_from_s), text(gaps.first_to_s), in_s ? "s" : "min"));
}

void keep(std::vector<double>& values, const std::vector<char>& kept) {
  std::size_t to = 0;
  for (std::size_t row = 0; row < kept.size(); ++row) {
    if (kept[row] != 0) values[to++] = values[row];
  }
  values.resize(to);
}

Series merged_parts(std::span<const Series> parts, const std::optional<double>& max_gap_s) {
  Parts all = parts_on_one_clock(parts, max_gap_s);
  if (all.gaps.empty()) return std::move(all.series);
  const std::vector<char> kept = kept_rows(all);
  expect_enough(all, kept);
  keep(all.series.time_s, kept);
  for (Column& column : all.series.columns) keep(column.values, kept);
  return std::move(all.series);
}

}  // namespace

Series merged(const std::vector<Series>& parts, std::optional<double> max_gap_s) {
  return merged_parts(parts, max_gap_s);
}

std::vector<RowsWithout> rows_without_signal(std::span<const Series> parts, std::optional<double> max_gap_s) {
  std::vector<RowsWithout> without;
  for (const Gaps& gaps : parts_on_one_clock(parts, max_gap_s).gaps) {
    without.push_back({gaps.signal, gaps.rows.size(), gaps.max_gap_s});
  }
  return without;
}

std::optional<SignalGap> longest_gap(std::span<const Series> parts, std::optional<double> max_gap_s) {
  const Parts all = parts_on_one_clock(parts, max_gap_s);
  std::optional<SignalGap> longest;
  if (keeps_enough(all.series, kept_rows(all))) return longest;
  for (const Gaps& gaps : all.gaps) {
    if (longest && longest->to_s - longest->from_s >= gaps.longest_to_s - gaps.longest_from_s) continue;
    longest = SignalGap{gaps.signal, gaps.longest_from_s, gaps.longest_to_s};
  }
  return longest;
}

std::shared_ptr<const Series> with_gaps_closed(std::shared_ptr<const Series> series, std::optional<double> max_gap_s) {
  const auto has_gap = [](const Column& column) {
    return column.role != Role::measured &&
           std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isnan(value); });
  };
  if (!series->time_s.empty() && std::none_of(series->columns.begin(), series->columns.end(), has_gap)) {
    expect_different_names({series.get(), 1});
    return series;
  }
  Series closed = merged_parts({series.get(), 1}, max_gap_s);
  closed.started = series->started;
  return std::make_shared<const Series>(std::move(closed));
}

}  // namespace ballbar
