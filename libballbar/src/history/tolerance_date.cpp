#include "ballbar/history/tolerance_date.hpp"

#include <cmath>

namespace ballbar {
namespace {

constexpr int kSteps = 120;  // a month each

// The first time from the last test on when the line is beyond the limit with that chance.
std::optional<double> reached_s(const Trend& trend, double limit, bool upper, double chance) {
  const auto beyond = [&](double time_s) {
    const double above = chance_above(trend, time_s, limit);
    return (upper ? above : 1.0 - above) >= chance;
  };
  const double step_s = kForecast_years * kYear_s / kSteps;
  double before_s = trend.last_s;
  if (beyond(before_s)) return before_s;
  for (int step = 1; step <= kSteps; ++step) {
    double after_s = trend.last_s + step_s * step;
    if (!beyond(after_s)) {
      before_s = after_s;
      continue;
    }
    while (after_s - before_s > 3600.0) {
      const double middle_s = 0.5 * (before_s + after_s);
      (beyond(middle_s) ? after_s : before_s) = middle_s;
    }
    return after_s;
  }
  return std::nullopt;
}

}  // namespace

ToleranceDate tolerance_date(const Tolerance& tolerance, double last_value, const std::optional<Trend>& trend) {
  ToleranceDate date;
  if (!within(tolerance, last_value)) {
    date.outlook = Outlook::beyond;
    date.limit = tolerance.upper && last_value > *tolerance.upper ? tolerance.upper : tolerance.lower;
    return date;
  }
  if (!trend || !trend->significant) return date;
  const bool upper = trend->rate_per_year > 0.0;
  date.outlook = Outlook::away;
  date.limit = upper ? tolerance.upper : tolerance.lower;
  if (!date.limit) return date;
  date.at_s = reached_s(*trend, *date.limit, upper, 0.5);
  if (!date.at_s) return date;
  date.outlook = Outlook::expected;
  date.earliest_s = reached_s(*trend, *date.limit, upper, 0.025).value_or(*date.at_s);
  date.latest_s = reached_s(*trend, *date.limit, upper, 0.975);
  return date;
}

}  // namespace ballbar
