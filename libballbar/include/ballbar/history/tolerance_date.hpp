// When a quantity meets its tolerance if its trend goes on.
#pragma once

#include <optional>

#include "ballbar/history/machine_test.hpp"
#include "ballbar/history/trend.hpp"

namespace ballbar {

inline constexpr double kForecast_years = 10.0;  // as far as a straight line is drawn

enum class Outlook {
  beyond,    // the last value is
  no_trend,  // too few tests, or none that is significant
  away,      // the trend goes to an end that is open, or reaches none within kForecast_years
  expected,  // within kForecast_years
};

struct ToleranceDate {
  Outlook outlook = Outlook::no_trend;
  std::optional<double> limit;  // the end that the trend goes to
  // s since 1970-01-01T00:00:00: when the line meets the limit as likely as not, and the interval of 95 %, from the
  // last test on. `latest` is missing where a straight line may never meet it within kForecast_years.
  std::optional<double> at_s, earliest_s, latest_s;
};

ToleranceDate tolerance_date(const Tolerance& tolerance, double last_value, const std::optional<Trend>& trend);

}  // namespace ballbar
