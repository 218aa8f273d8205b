#include "logs/log_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "logs/time_stamp.hpp"

namespace ballbar {
namespace {

constexpr double kHour_s = 3600.0;
constexpr double kYear_s = 365.0 * kDay_s;  // of dates that lack theirs

double rounded(double value, double step) { return step > 0.0 ? std::round(value / step) * step : value; }

// 0.1 and not 0.10000000000000142: the nearest number of so many decimals.
double to_decimals(double value, double step) {
  const double inverse = std::round(1.0 / step);
  return std::round(value * inverse) / inverse;
}

unsigned month_of(std::int64_t day) {
  return static_cast<unsigned>(std::chrono::year_month_day(std::chrono::sys_days(std::chrono::days(day))).month());
}

// A night from Saturday to Sunday, as all changes of summer time are, between 0 and 4 h.
bool may_change(std::int64_t day, double clock_s) {
  const std::chrono::weekday weekday{std::chrono::sys_days(std::chrono::days(day))};
  const double in_day = clock_s - std::floor(clock_s / kDay_s) * kDay_s;
  const unsigned month = month_of(day);
  const bool season = month == 3 || month == 4 || (month >= 9 && month <= 11);
  return season && weekday == std::chrono::Sunday && in_day <= 4.0 * kHour_s;
}

class Clock {
 public:
  Clock(const LogTable& table, const LogPlan& plan, const std::string& name, std::vector<std::string>& remarks)
      : table_(table), plan_(plan), name_(name), remarks_(remarks) {}

  void run_on(std::vector<double>& time_s) {
    const double step_s = median_step_s(time_s);
    const double slack_s = std::max(3.0, 2.5 * step_s);
    const bool may_turn = !table_.first_day || table_.lacks_year;
    const double turn_s = table_.lacks_year ? kYear_s : plan_.time.minutes_and_seconds ? kHour_s : kDay_s;
    double added_s = 0.0;
    std::size_t turns = 0, half_turns = 0;
    const bool is_of_12_hours =
        std::all_of(time_s.begin(), time_s.end(), [](double written_s) { return written_s < 13.0 * kHour_s; });
    for (std::size_t i = 1; i < time_s.size(); ++i) {
      const double before_s = time_s[i - 1] - added_s;  // as written
      const double change_s = time_s[i] - before_s;
      const bool dated = table_.first_day.has_value();
      const bool may_change_time = dated && !table_.zoned && !table_.lacks_year;
      const auto day = [&](double written_s) {
        return *table_.first_day + static_cast<std::int64_t>(std::floor(written_s / kDay_s));
      };
      if (change_s < 0.0) {
        if (may_turn && change_s < -0.5 * turn_s) {
          added_s += turn_s;
          ++turns;
        } else if (may_change_time && std::abs(change_s + kHour_s - step_s) <= slack_s &&
                   may_change(day(time_s[i]), time_s[i])) {
          added_s += kHour_s;
          remarks_.push_back(
              fmt::format("The clock goes back an hour at line {}, the end of summer time: the time continues.",
                          table_.line_of(i)));
        } else if (!dated && is_of_12_hours && std::abs(change_s + 0.5 * kDay_s - step_s) <= slack_s) {
          added_s += 0.5 * kDay_s;
          if (half_turns++ == 0)
            remarks_.push_back(fmt::format(
                "The clock falls by 12 h at line {}, read as one of 12 hours: the time continues.", table_.line_of(i)));
        } else if (!dated && std::abs(change_s + kHour_s - step_s) <= slack_s && before_s <= 4.0 * kHour_s) {
          added_s += kHour_s;
          remarks_.push_back(
              fmt::format("The clock goes back an hour at line {}, read as the end of summer time: the time continues.",
                          table_.line_of(i)));
        } else {
          fail_back(i, -change_s);
        }
      } else if (may_change_time && change_s > 0.0 && std::abs(change_s - kHour_s - step_s) <= slack_s &&
                 kHour_s > 4.0 * step_s && may_change(day(time_s[i]), time_s[i]) && in_spring(day(time_s[i]))) {
        added_s -= kHour_s;
        remarks_.push_back(fmt::format("The clock goes forward an hour at line {}, the start of summer time: no gap.",
                                       table_.line_of(i)));
      }
      time_s[i] += added_s;
      if (time_s[i] < time_s[i - 1]) fail_back(i, time_s[i - 1] - time_s[i]);
    }
    if (turns == 0) return;
    remarks_.push_back(plan_.time.minutes_and_seconds
                           ? fmt::format("The minutes restart {} times: the time continues.", turns)
                           : fmt::format("Past {} {}: the time continues.", table_.lacks_year ? "New Year" : "midnight",
                                         turns == 1 ? "once" : fmt::format("{} times", turns)));
  }

  // Rows of one stamp: evenly to the next stamp's, or within the second or minute to which stamps are written.
  void spread(std::vector<double>& time_s) {
    const bool any = std::adjacent_find(time_s.begin(), time_s.end()) != time_s.end();
    if (!any) return;
    const auto again = static_cast<std::size_t>(
        std::count_if(time_s.begin() + 1, time_s.end(),
                      [before = time_s.front()](double t) mutable { return std::exchange(before, t) == t; }));
    if (is_dates_alone() && 2 * again > time_s.size()) {
      throw Error(
          fmt::format("{}:{}: expected a clock beside the dates, found {} rows with the date of the row before. State "
                      "how far apart "
                      "they are, --every 5min, or --time none.",
                      name_, table_.line_of(0), again));
    }
    const double resolution_s = resolution(time_s);
    std::size_t rows = 0;
    for (std::size_t i = 0; i < time_s.size();) {
      const std::size_t end = end_of_group(time_s, i);
      const std::size_t count = end - i;
      const double first_s = time_s[i];
      const double span_s = end < time_s.size() ? std::min(resolution_s, time_s[end] - first_s) : resolution_s;
      if (count > 1) {
        for (std::size_t k = 0; k < count; ++k) {
          time_s[i + k] = first_s + span_s * static_cast<double>(k) / static_cast<double>(count);
        }
        rows += count;
      }
      i = end;
    }
    remarks_.push_back(fmt::format("{} rows have the same time as another, written to {:g} s: they are spread evenly.",
                                   rows, resolution_s));
  }

 private:
  static bool in_spring(std::int64_t day) {
    const unsigned month = month_of(day);
    return month == 3 || month == 4 || month == 9 || month == 10;
  }

  static std::size_t end_of_group(const std::vector<double>& time_s, std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < time_s.size() && time_s[end] == time_s[begin]) ++end;
    return end;
  }

  [[nodiscard]] bool is_dates_alone() const {
    return plan_.time.kind == TimePlan::Kind::stamps && table_.first_day && !table_.has_clock &&
           plan_.columns[plan_.time.column].kind == ColumnKind::stamp;
  }

  // To what the stamps are written: minutes, seconds, or the smallest step.
  double resolution(const std::vector<double>& time_s) const {
    const auto all = [&](double unit_s) {
      return std::all_of(time_s.begin(), time_s.end(),
                         [&](double t) { return std::abs(t - rounded(t, unit_s)) < 1e-9; });
    };
    if (all(60.0)) return 60.0;
    if (all(1.0)) return 1.0;
    double least = median_step_s(time_s);
    for (std::size_t i = 1; i < time_s.size(); ++i) {
      if (time_s[i] > time_s[i - 1]) least = std::min(least, time_s[i] - time_s[i - 1]);
    }
    return least > 0.0 ? least : 1.0;
  }

  [[noreturn]] void fail_back(std::size_t row, double back_s) const {
    throw Error(
        fmt::format("{}:{}: expected a time above that of the row before, found one {:g} s earlier. If another "
                    "recording starts here, split the file.",
                    name_, table_.line_of(row), back_s));
  }

  const LogTable& table_;
  const LogPlan& plan_;
  const std::string& name_;
  std::vector<std::string>& remarks_;
};

// Rows that repeat rows above, as of a log that was saved twice or that goes on from a copy, are left out.
bool leave_out_repeated_rows(LogTable& table, const std::vector<double>& time_s, std::vector<std::string>& remarks) {
  const auto falls = std::adjacent_find(time_s.begin(), time_s.end(), std::greater<>());
  if (falls == time_s.end()) return false;
  const auto begin = static_cast<std::size_t>(falls - time_s.begin()) + 1;
  const auto first = static_cast<std::size_t>(
      std::lower_bound(time_s.begin(), time_s.begin() + static_cast<std::ptrdiff_t>(begin), time_s[begin]) -
      time_s.begin());
  const std::size_t count = begin - first, end = begin + std::min(count, time_s.size() - begin);
  const auto same = [&](const std::vector<double>& values) {
    for (std::size_t row = begin; row < end; ++row) {
      const double now = values[row], before = values[row - count];
      if (now != before && !(std::isnan(now) && std::isnan(before))) return false;
    }
    return true;
  };
  const bool is_repeated =
      end - begin > 1 && (end == time_s.size() || end - begin == count) && same(time_s) &&
      std::all_of(table.values.begin(), table.values.end(),
                  [&](const std::vector<double>& values) { return values.size() != time_s.size() || same(values); });
  if (!is_repeated) return false;
  remarks.push_back(
      fmt::format("The {} rows from line {} on repeat rows above: left out.", end - begin, table.line_of(begin)));
  std::vector<std::size_t> rows(table.rows);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(begin), rows.begin() + static_cast<std::ptrdiff_t>(end));
  keep_rows(rows, table);
  return true;
}

// Puts rows in the order of their times: a log whose newest row comes first, and one with a date in each row that has
// whole blocks or a few single rows in other places. Rows of two blocks that alternate, or have the same time, are of a
// clock that was set back.
void put_in_order(LogTable& table, const std::vector<double>& time_s, bool is_dated,
                  std::vector<std::string>& remarks) {
  constexpr std::size_t kChangesOfBlock = 3;  // of the block, from row to row in order
  constexpr double kLongestBack_s = 0.5 * kYear_s;
  std::vector<std::size_t> rows(time_s.size()), block(time_s.size(), 0);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  if (time_s.size() > 2 && time_s.back() < time_s.front() && std::is_sorted(time_s.rbegin(), time_s.rend())) {
    std::reverse(rows.begin(), rows.end());
    keep_rows(rows, table);
    remarks.push_back("The newest row comes first in the file: the rows are read from the last one on.");
    return;
  }
  if (!is_dated) return;
  std::size_t first = 0;  // that is earlier than the one above
  for (std::size_t row = 1; row < time_s.size(); ++row) {
    const bool falls = time_s[row] < time_s[row - 1];
    block[row] = block[row - 1] + falls;
    if (!falls) continue;
    if (first == 0) first = row;
    if (time_s[row] < time_s[row - 1] - kLongestBack_s) return;  // a year that was not counted on
    if (table.first_day &&
        may_change(*table.first_day + static_cast<std::int64_t>(std::floor(time_s[row] / kDay_s)), time_s[row]))
      return;
  }
  if (first == 0) return;
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return time_s[a] < time_s[b]; });
  std::size_t changes = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (block[rows[k]] == block[rows[k - 1]]) continue;
    if (time_s[rows[k]] == time_s[rows[k - 1]]) return;
    ++changes;
  }
  if (changes > kChangesOfBlock * block.back()) return;
  remarks.push_back(fmt::format(
      "Line {} is earlier than the line above: the rows are read in the order of their times.", table.line_of(first)));
  keep_rows(rows, table);
}

}  // namespace

std::vector<double> clock_s(LogTable& table, const LogPlan& plan, const std::string& name,
                            std::optional<double>& started_s, std::vector<std::string>& remarks) {
  const TimePlan& time = plan.time;
  std::vector<double> time_s;
  if (time.kind == TimePlan::Kind::rows) {
    time_s.reserve(table.rows);
    for (std::size_t row = 0; row < table.rows; ++row) {
      time_s.push_back(to_decimals(static_cast<double>(row) * time.every_s, 1e-9));
    }
    return time_s;
  }
  const auto written = [&]() -> const std::vector<double>& {
    return time.kind == TimePlan::Kind::number ? table.values[time.column] : table.time_s;
  };
  while (leave_out_repeated_rows(table, written(), remarks)) continue;
  put_in_order(table, std::vector(written()), time.zero_s || (table.first_day && !table.lacks_year), remarks);
  Clock clock(table, plan, name, remarks);
  if (time.kind == TimePlan::Kind::number) {
    time_s = std::move(table.values[time.column]);
    if (time.zero_s) {
      const double first = time_s.front();
      started_s = rounded(first * time.unit_s + *time.zero_s, 1e-3);
      for (double& value : time_s) value = to_decimals((value - first) * time.unit_s, time.resolution_s);
    } else if (time.resolution_s > 0.0) {
      for (double& value : time_s) value = to_decimals(value * time.unit_s, time.resolution_s);
    }
    const auto falls = std::adjacent_find(time_s.begin(), time_s.end(), [](double a, double b) { return b < a; });
    if (falls != time_s.end()) {
      const auto row = static_cast<std::size_t>(falls - time_s.begin()) + 1;
      throw Error(
          fmt::format("{}:{}: expected a time above {:g} s of the row before, found {:g} s. If another recording "
                      "starts here, split the file.",
                      name, table.line_of(row), time_s[row - 1], time_s[row]));
    }
  } else {
    time_s = std::move(table.time_s);
    clock.run_on(time_s);
    // A clock starts at the first row; times since a start stay as they are.
    const double first_s = table.elapsed && !table.first_day ? 0.0 : time_s.front();
    if (table.first_day && !table.lacks_year) started_s = static_cast<double>(*table.first_day) * kDay_s + first_s;
    for (double& value : time_s) value = to_decimals(value - first_s, 1e-9);
  }
  clock.spread(time_s);
  const auto stands =
      std::adjacent_find(time_s.begin(), time_s.end(), [](double before, double after) { return !(after > before); });
  if (stands != time_s.end()) {
    const auto row = static_cast<std::size_t>(stands - time_s.begin()) + 1;
    throw Error(fmt::format("{}:{}: expected a time above that of the row before, found {:g} s after {:g} s.", name,
                            table.line_of(row), time_s[row], time_s[row - 1]));
  }
  return time_s;
}

}  // namespace ballbar
