#include "ballbar/internal/series/sessions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/series/series.hpp"
#include "series/pause.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr double kSigmasOfZero = 3.0;
constexpr double kLeastPause_s = 1200.0;
constexpr double kRound = 100.0;  // a probe may be set to a multiple, which no reading is near by itself
constexpr double kElsewhere = 2.0, kFarElsewhere = 10.0;  // times that, before a night, and before a shorter pause
constexpr std::size_t kRowsOfSession = 4;

// How far from what it was set to the reading of a probe is: three times its scatter, from differences of
// neighbours, and half a resolution.
double near_setting(const std::vector<double>& values) {
  constexpr double kMedianOfDifference = 0.95;  // of a normal distribution, in sigma of a value
  std::vector<double> sizes;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double size = std::abs(values[i] - values[i - 1]);
    if (std::isfinite(size)) sizes.push_back(size);
  }
  const double sigma = sizes.empty() ? 0.0 : median(std::move(sizes)) / kMedianOfDifference;
  return std::max(kSigmasOfZero * sigma, 0.5 * resolution_of(values) * (1.0 + 1e-9));
}

// The first and the last reading of some rows.
double first_reading(const std::vector<double>& values, const RowRange& rows) {
  std::size_t row = rows.begin;
  while (row + 1 < rows.end && std::isnan(values[row])) ++row;
  return values[row];
}
double last_reading(const std::vector<double>& values, const RowRange& rows) {
  std::size_t row = rows.end - 1;
  while (row > rows.begin && std::isnan(values[row])) --row;
  return values[row];
}

}  // namespace

std::vector<RowRange> sessions_of(const Series& data, const std::vector<std::string>& targets) {
  std::vector<const Column*> probes;
  probes.reserve(targets.size());
  for (const std::string& name : targets) probes.push_back(find_column(data, name));
  const std::vector<RowRange> parts = between_pauses(data.time_s, kLeastPause_s);
  if (parts.size() < 2 || probes.empty() || !data.has_clock) return {};
  std::vector<RowRange> sessions{parts.front()};
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const bool is_night = data.time_s[parts[k].begin] - data.time_s[parts[k].begin - 1] >= kRest_s;
    bool is_zeroed = parts[k].end - parts[k].begin >= kRowsOfSession, was_elsewhere = false;
    for (const Column* probe : probes) {
      const double near = near_setting(probe->values), first = first_reading(probe->values, parts[k]);
      const double round = kFarElsewhere * near < kRound ? kRound * std::round(first / kRound) : 0.0;
      const double settings[] = {0.0, first_reading(probe->values, parts.front()), round};
      const auto* const setting = std::find_if(std::begin(settings), std::end(settings),
                                               [&](double value) { return std::abs(first - value) <= near; });
      is_zeroed = is_zeroed && setting != std::end(settings);
      was_elsewhere = was_elsewhere || (is_zeroed && std::abs(last_reading(probe->values, parts[k - 1]) - *setting) >
                                                         (is_night ? kElsewhere : kFarElsewhere) * near);
    }
    if (is_zeroed && was_elsewhere)
      sessions.push_back(parts[k]);
    else
      sessions.back().end = parts[k].end;
  }
  return sessions.size() < 2 ? std::vector<RowRange>{} : sessions;
}

}  // namespace ballbar
