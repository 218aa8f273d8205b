// The lag between the clocks of two loggers, from a quantity that both logged.
#pragma once

#include <optional>
#include <string>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct ClockLag {
  std::string column, other;  // compared columns of the first and the second series
  double lag_s = 0.0;         // add this to the times of the second series
  double sigma_s = 0.0;
  double correlation = 0.0;  // of the two columns at that lag
};

// Compares pairs of columns that may show the same quantity: equal names, two speeds, a speed and a load, two room
// temperatures, two coolant temperatures. For each pair the second column is shifted by lags up to +-`range_s` and
// scaled by least squares, where both have values. The pair with the largest correlation is used. Returns nullopt where
// there is no such pair, where no correlation reaches 0.7, or where a different lag fits nearly as well.
//
// sigma comes from the curvature of the sum of squares in the lag, with the effective number of independent readings.
// It is at least the distance of the rows over the square root of 12: the steps of a programme may all lie at the same
// place between two rows. O(lags n), n at most 4000 rows.
std::optional<ClockLag> clock_lag(const Series& first, const Series& second, double range_s);

}  // namespace ballbar
