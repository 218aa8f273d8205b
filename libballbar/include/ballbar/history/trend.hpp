// A linear trend through dated values that scatter by more than their sigmas.
//
//   y_i = v + r (t_i - t_last) + e_i,     var e_i = sigma_i^2 + tau^2
//
// tau, the scatter of a machine from test to test (set-up, temperature), is unknown, and few tests determine it poorly.
// The line is therefore averaged over tau, weighted by the restricted likelihood times a half-Cauchy prior with a scale
// of three times the usual sigma. Intervals of three tests are then wide enough, and those of many tests approach
// weighted least squares with the scatter added. Values without a sigma take the usual sigma of the others. If no value
// has one, the prior is 1/tau, which gives Student's t.
//
// Sources: D. A. Harville, J. Am. Stat. Assoc. 72 (1977): restricted likelihood. A. Gelman, Bayesian Analysis 1 (2006):
// half-Cauchy priors for the variance between groups.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ballbar/history/machine_test.hpp"

namespace ballbar {

inline constexpr double kYear_s = 365.25 * 86400.0;
inline constexpr double kDay_s = 86400.0;
// A change or a trend is significant beyond this many sigmas; one in 107 is so by chance.
inline constexpr double kSignificantSigmas = 2.6;

struct DatedValue {
  double time_s = 0.0;
  double value = 0.0;
  double sigma = 0.0;  // NaN: not known
};

// The line for one tau: value at the last test and rate per year, normal with this covariance.
struct TrendLine {
  double weight = 1.0;  // the weights of all lines sum to 1
  double value = 0.0, rate_per_year = 0.0;
  double value_variance = 0.0, covariance = 0.0, rate_variance = 0.0;
};

struct Trend {
  std::size_t tests = 0;
  double last_s = 0.0;
  double rate_per_year = 0.0;
  double sigma_per_year = 0.0;  // half of the 68.3 % interval
  double p_value = 1.0;         // two-sided, of rate 0
  bool significant = false;     // beyond kSignificantSigmas
  double scatter = 0.0;         // median of tau
  std::vector<TrendLine> lines;
};

// Returns nullopt for fewer than 3 values, or if all lie within a week. Values in any order. O(n).
std::optional<Trend> trend_of(std::span<const DatedValue> values);

// The probability that the line at `time_s` is above the limit, and the quantile of the line at `time_s`.
double chance_above(const Trend& trend, double time_s, double limit);
double quantile(const Trend& trend, double time_s, double chance);

// When a quantity reaches its tolerance if its trend continues.

inline constexpr double kForecast_years = 10.0;  // longest extrapolation of a trend

enum class Outlook {
  beyond,    // the last value exceeds the tolerance
  no_trend,  // too few tests, or no significant trend
  away,      // the trend leads to an open end, or reaches no limit within kForecast_years
  expected,  // the trend reaches a limit within kForecast_years
};

struct ToleranceDate {
  Outlook outlook = Outlook::no_trend;
  std::optional<double> limit;  // the limit that the trend leads to
  // In s since 1970-01-01T00:00:00: median of the time at which the line reaches the limit, and its 95 % interval, from
  // the last test on. `latest_s` is nullopt if the line may not reach the limit within kForecast_years.
  std::optional<double> at_s, earliest_s, latest_s;
};

ToleranceDate tolerance_date(const Tolerance& tolerance, double last_value, const std::optional<Trend>& trend);

}  // namespace ballbar
