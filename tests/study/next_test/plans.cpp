#include "next_test/plans.hpp"

#include <algorithm>
#include <cmath>

#include "verdicts/chance.hpp"

namespace ballbar::next_test {
namespace {

constexpr double kHour_s = 3600.0;
constexpr double kRest_s = 600.0;  // before anything else
constexpr double kStep_K = 3.0;

// The speeds of the data that were kept for 10 min, 0 among them, rising.
std::vector<double> kept_speeds(const Series& data) {
  std::vector<double> kept{0.0};
  for (const Column& column : data.columns) {
    if (column.role != Role::speed) continue;
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= column.values.size(); ++i) {
      if (i < column.values.size() && column.values[i] == column.values[begin]) continue;
      if (data.time_s[i - 1] - data.time_s[begin] >= 600.0) kept.push_back(column.values[begin]);
      begin = i;
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

double middle_of_widest_gap(const std::vector<double>& rising) {
  double widest = 0.0, middle = 0.0;
  for (std::size_t i = 1; i < rising.size(); ++i) {
    if (rising[i] - rising[i - 1] <= widest) continue;
    widest = rising[i] - rising[i - 1];
    middle = 0.5 * (rising[i] + rising[i - 1]);
  }
  return 100.0 * std::round(middle / 100.0);
}

Schedule repeated(const std::vector<Dwell>& pattern, double hours) {
  Schedule schedule;
  schedule.dwells.push_back({kRest_s});
  const double end_s = hours * kHour_s;
  do {
    for (Dwell dwell : pattern) {
      if (hours > 0.0) dwell.duration_s = std::min(dwell.duration_s, end_s - duration_s(schedule));
      if (dwell.duration_s > 0.0) schedule.dwells.push_back(dwell);
    }
  } while (duration_s(schedule) < end_s);
  return schedule;
}

}  // namespace

Schedule staircase(double hours, double max_rpm, std::uint64_t seed) {
  verdicts::Chance chance("staircase", seed);
  Schedule schedule;
  schedule.dwells.push_back({kRest_s});
  double left_s = hours * kHour_s - kRest_s;
  while (left_s > 0.0) {
    const double last_rpm = schedule.dwells.back().speed_rpm;
    double next_rpm = last_rpm;
    while (next_rpm == last_rpm) {
      next_rpm = chance.happens(0.25) ? 0.0 : 100.0 * std::round(chance.between(0.1, 1.0) * max_rpm / 100.0);
    }
    const double stays_s = 60.0 * std::round(chance.log_between(10.0, 60.0));
    schedule.dwells.push_back({std::min(stays_s, left_s), next_rpm});
    left_s -= stays_s;
  }
  return schedule;
}

std::vector<FixedPlan> fixed_plans(const Series& data, double hours, double max_rpm) {
  const std::vector<double> kept = kept_speeds(data);
  const double full = kept.size() > 1 ? kept.back() : max_rpm;
  const double other = kept.size() > 1 ? middle_of_widest_gap(kept) : 0.5 * max_rpm;
  const double h = kHour_s;
  const auto times = [](std::size_t count, const std::vector<Dwell>& dwells) {
    std::vector<Dwell> result;
    for (std::size_t k = 0; k < count; ++k) result.insert(result.end(), dwells.begin(), dwells.end());
    return result;
  };
  std::vector<Dwell> two_lengths = times(6, {{h / 6.0, full}, {h / 6.0, 0.0}});
  two_lengths.insert(two_lengths.end(), {{h, full}, {h, 0.0}});
  const std::vector<std::pair<const char*, std::vector<Dwell>>> patterns{
      {"at rest", {{3.0 * h, 0.0}}},
      {"room step at rest", {{h, 0.0}, {3.0 * h, 0.0, 1.0, kStep_K}}},
      {"standstill from warm", {{h, full}, {2.0 * h, 0.0}}},
      {"stop and go", {{h, 0.0}, {h, full}, {h, 0.0}}},
      {"another speed", {{2.0 * h, other}, {h, 0.0}}},
      {"several cycles", times(3, {{h / 1.5, full}, {h / 1.5, 0.0}})},
      {"two dwell lengths", two_lengths},
      {"room step at speed", {{2.0 * h, full}, {2.0 * h, full, 1.0, kStep_K}}},
      {"coolant step", {{2.0 * h, full}, {2.0 * h, full, 1.0, 0.0, kStep_K}}},
      {"load step", {{2.0 * h, full}, {2.0 * h, full, 2.0}}}};
  std::vector<FixedPlan> plans;
  plans.reserve(patterns.size());
  for (const auto& [name, dwells] : patterns) plans.push_back({name, repeated(dwells, hours)});
  return plans;
}

}  // namespace ballbar::next_test
