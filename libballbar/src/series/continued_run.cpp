#include "ballbar/internal/series/continued_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kLongestPause_s = 8.0 * 3600.0;  // a machine that stood longer begins another run
constexpr double kMostSteps = 10.0;               // of hourly readings that is longer
constexpr double kSameTime_s = 1e-6;              // dates are sums of seconds
constexpr double kSameValue = 1e-6;               // a table may hold them as 32-bit numbers
constexpr double kMostOffLine = 2.0;  // steps: white noise is 0.9 off the line, another run as much as it varies

// The times of the other on the clock of the run; those of a row of the run are its own, to the last bit.
std::vector<double> on_clock_of(const Series& run, const Series& other, double clock_s) {
  std::vector<double> times_s;
  times_s.reserve(other.time_s.size());
  for (const double time_s : other.time_s) {
    const double at_s = time_s + clock_s;
    const auto next = std::lower_bound(run.time_s.begin(), run.time_s.end(), at_s - kSameTime_s);
    times_s.push_back(next != run.time_s.end() && *next <= at_s + kSameTime_s ? *next : at_s);
  }
  return times_s;
}

// Whether the values at these times may be of the same run; where the run has a gap, nothing tells.
bool suits(const Series& run, const std::vector<double>& of_run, const std::vector<double>& times_s,
           const std::vector<double>& values) {
  const double longest_s = kMostSteps * median_step_s(run.time_s);
  double off_line = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const auto place = place_of(run.time_s, times_s[i]);
    if (!place || !std::isfinite(values[i])) continue;
    const double line = value_at(of_run, *place);
    if (!std::isfinite(line)) continue;
    const double off = std::abs(values[i] - line);
    if (place->share == 0.0) {
      if (off > kSameValue * std::max(1.0, std::abs(line))) return false;
    } else if (run.time_s[place->row + 1] - run.time_s[place->row] <= longest_s) {
      off_line += off;
      steps += std::abs(of_run[place->row + 1] - of_run[place->row]);
    }
  }
  return off_line <= kMostOffLine * steps;
}

}  // namespace

std::optional<ContinuedRun> continued_run(const Series& run, const Series& other,
                                          const std::vector<std::string>& inputs, double clock_s) {
  if (run.time_s.empty() || other.time_s.empty() || run.has_clock != other.has_clock) return std::nullopt;
  ContinuedRun result;
  result.time_s = on_clock_of(run, other, clock_s);
  const double first_s = run.time_s.front(), last_s = run.time_s.back();
  result.pause_s = std::max(0.0, result.time_s.front() - last_s);
  if (result.time_s.back() < first_s) return std::nullopt;
  if (result.pause_s > std::max(kLongestPause_s, kMostSteps * median_step_s(run.time_s))) return std::nullopt;
  std::vector<const Column*> of_run, of_other;
  for (const std::string& name : inputs) {
    of_run.push_back(find_column(run, name));
    of_other.push_back(find_column(other, name));
    if (of_run.back() == nullptr || of_other.back() == nullptr) return std::nullopt;
    if (!suits(run, of_run.back()->values, result.time_s, of_other.back()->values)) return std::nullopt;
  }
  Series& series = result.series;
  series.has_clock = run.has_clock;
  for (const Column* column : of_run) series.columns.push_back({column->name, column->role, {}, column->header});
  std::size_t i = 0, j = 0;
  while (j < result.time_s.size() && result.time_s[j] < first_s) result.time_s[j++] = kUnknown;
  while (i < run.time_s.size() || j < result.time_s.size()) {
    const bool is_of_run = i < run.time_s.size() && (j == result.time_s.size() || run.time_s[i] <= result.time_s[j]);
    const bool is_of_both = is_of_run && j < result.time_s.size() && run.time_s[i] == result.time_s[j];
    series.time_s.push_back(is_of_run ? run.time_s[i] : result.time_s[j]);
    for (std::size_t c = 0; c < of_run.size(); ++c)
      series.columns[c].values.push_back(is_of_run ? of_run[c]->values[i] : of_other[c]->values[j]);
    i += is_of_run ? 1 : 0;
    j += is_of_run && !is_of_both ? 0 : 1;
  }
  return result;
}

}  // namespace ballbar
