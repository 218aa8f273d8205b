// A straight line through values of several dates, where the tests scatter by more than their sigmas.
//
//   y_i = v + r (t_i - t_last) + e_i,     var e_i = sigma_i^2 + tau^2
//
// tau, by which a machine differs from test to test (set-up, warmth), is not known, and of few tests it is badly
// known: the line is averaged over tau, each with its restricted likelihood times a half-Cauchy prior of three times
// the usual sigma. So the intervals of three tests are as wide as they must be, and those of many approach weighted
// least squares with the scatter added. Values without a sigma take the usual one of the others; where no value has
// one, tau alone tells, with the prior 1/tau: Student's t.
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
// A change or a trend beyond that many sigmas is one; by chance one in 107 is.
inline constexpr double kSignificantSigmas = 2.6;

struct DatedValue {
  double time_s = 0.0;
  double value = 0.0;
  double sigma = 0.0;  // NaN: not known
};

// One tau: value at the last test and rate a year, normal with this covariance.
struct TrendLine {
  double weight = 1.0;  // all sum to 1
  double value = 0.0, rate_per_year = 0.0;
  double value_variance = 0.0, covariance = 0.0, rate_variance = 0.0;
};

struct Trend {
  std::size_t tests = 0;
  double last_s = 0.0;
  double rate_per_year = 0.0;
  double sigma_per_year = 0.0;  // half of the interval that holds 68.3 %
  double p_value = 1.0;         // of a rate as far from 0 by chance, on either side
  bool significant = false;     // beyond kSignificantSigmas
  double scatter = 0.0;         // tau, the median: from test to test beyond the sigmas
  std::vector<TrendLine> lines;
};

// Nothing for fewer than 3 values or within a week. Values in any order. O(n).
std::optional<Trend> trend_of(std::span<const DatedValue> values);

// Of the line at that time: the chance that it is above the limit, and the value that it is below with that chance.
double chance_above(const Trend& trend, double time_s, double limit);
double quantile(const Trend& trend, double time_s, double chance);

// When a quantity meets its tolerance if its trend goes on.

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
