#include <algorithm>
#include <cmath>

#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/series/speed_steps.hpp"
#include "series/standstill.hpp"

namespace ballbar {
namespace {

constexpr double kAfterChange_s = 600.0, kWarming_s = 3600.0, kCooling_s = 7200.0;

Regime later(double since_s, double before_rpm, double speed_rpm, double largest_rpm) {
  const bool rest = at_standstill(speed_rpm, largest_rpm);
  const double rise = std::abs(speed_rpm) - std::abs(before_rpm);
  if ((rest || rise < -0.02 * largest_rpm) && since_s < kCooling_s) return Regime::cooling;
  if (rest) return Regime::standstill;
  return rise > 0.02 * largest_rpm && since_s < kWarming_s ? Regime::warming : Regime::steady;
}

// Removes short rests for tests by joining the stretches around them.
std::vector<SpeedStep> without_stops(const std::vector<double>& time_s, const std::vector<SpeedStep>& steps,
                                     double largest_rpm) {
  const auto length_s = [&](const SpeedStep& step) { return time_s[step.end - 1] - time_s[step.begin]; };
  std::vector<SpeedStep> result;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto goes_on = [&](const SpeedStep& step) { return time_s[step.begin] >= time_s[step.begin - 1]; };
    const bool stop = !result.empty() && i + 1 < steps.size() && goes_on(steps[i]) && goes_on(steps[i + 1]) &&
                      at_standstill(steps[i].speed_rpm, largest_rpm) &&
                      std::abs(result.back().speed_rpm - steps[i + 1].speed_rpm) < 0.02 * largest_rpm &&
                      length_s(steps[i]) < std::min({kAfterChange_s, length_s(result.back()), length_s(steps[i + 1])});
    if (stop) {
      result.back().end = steps[++i].end;
    } else {
      result.push_back(steps[i]);
    }
  }
  return result;
}

}  // namespace

std::vector<Regime> regimes(const std::vector<double>& time_s, const Column& speed) {
  if (std::all_of(speed.values.begin(), speed.values.end(), [](double rpm) { return std::isnan(rpm); })) return {};
  const double largest_rpm = largest_of(speed.values);
  const std::vector<SpeedStep> steps = without_stops(time_s, speed_steps(time_s, speed), largest_rpm);
  std::vector<Regime> result(time_s.size(), Regime::standstill);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const SpeedStep& step = steps[i];
    const bool first = i == 0 || time_s[step.begin] < time_s[step.begin - 1];  // of a run
    if (first && at_standstill(step.speed_rpm, largest_rpm)) continue;
    const double before_rpm = first ? 0.0 : steps[i - 1].speed_rpm;
    for (std::size_t row = step.begin; row < step.end; ++row) {
      const double since_s = time_s[row] - time_s[step.begin];
      result[row] = !first && since_s < kAfterChange_s ? Regime::after_change
                                                       : later(since_s, before_rpm, step.speed_rpm, largest_rpm);
    }
  }
  return result;
}

std::vector<RegimeStretch> regime_stretches(const Series& data) {
  std::vector<RegimeStretch> stretches;
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  if (speed == data.columns.end()) return stretches;
  const std::vector<Regime> all = regimes(data.time_s, *speed);
  for (std::size_t row = 0; row < all.size(); ++row) {
    if (row > 0) stretches.back().to_s = data.time_s[row];
    if (row > 0 && all[row] == all[row - 1]) continue;
    stretches.push_back({all[row], data.time_s[row], data.time_s[row]});
  }
  return stretches;
}

std::string_view name_of(Regime regime) {
  switch (regime) {
    case Regime::standstill:
      return "standstill";
    case Regime::after_change:
      return "after a change of speed";
    case Regime::warming:
      return "warming";
    case Regime::steady:
      return "steady";
    case Regime::cooling:
      return "cooling";
  }
  return "";
}

}  // namespace ballbar
