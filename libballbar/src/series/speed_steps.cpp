#include "ballbar/internal/series/speed_steps.hpp"

#include <cmath>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/series/series.hpp"
#include "numerics/not_finite.hpp"
#include "series/standstill.hpp"

namespace ballbar {
namespace {

constexpr double kShortest_s = 60.0;
constexpr double kTolerance = 0.02;  // of the largest speed

double median_of_known(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  std::vector<double> known;
  for (std::size_t row = begin; row < end; ++row) {
    if (!std::isnan(values[row])) known.push_back(values[row]);
  }
  return known.empty() ? kUnknown : median(std::move(known));
}

void add_steps(const std::vector<double>& time_s, const std::vector<double>& rpm, const RowRange& run, double largest,
               std::vector<SpeedStep>& steps) {
  std::vector<std::size_t> starts{run.begin};
  std::vector<double> firsts;  // value that each finished step began with, its ramp left out
  double first = rpm[run.begin];
  std::size_t changed = run.begin;  // row of the last change of speed
  for (std::size_t row = run.begin + 1; row < run.end; ++row) {
    if (std::isnan(first)) first = rpm[row];
    if (!(std::abs(rpm[row] - first) > kTolerance * largest)) continue;
    if (time_s[row] - time_s[changed] >= kShortest_s) {
      starts.push_back(row);
      firsts.push_back(first);
    } else if (!firsts.empty() && time_s[row] - time_s[starts.back()] < kShortest_s &&
               std::abs(rpm[row] - firsts.back()) <= kTolerance * largest) {
      first = firsts.back();
      starts.pop_back();
      firsts.pop_back();
      changed = starts.back();
      continue;
    }
    changed = row;
    first = rpm[row];
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::size_t end = i + 1 < starts.size() ? starts[i + 1] : run.end;
    steps.push_back({median_of_known(rpm, starts[i], end), starts[i], end});
  }
}

}  // namespace

std::vector<SpeedStep> speed_steps(const std::vector<double>& time_s, const Column& speed) {
  const std::vector<double>& rpm = speed.values;
  const double largest = largest_of(rpm);
  std::vector<SpeedStep> steps;
  for (const RowRange& run : runs_of(time_s)) add_steps(time_s, rpm, run, largest, steps);
  return steps;
}

}  // namespace ballbar
