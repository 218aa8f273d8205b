// How much later one logger's clock is than another's, from a quantity that both logged.
#pragma once

#include <optional>
#include <string>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct ClockLag {
  std::string column, other;  // what was compared: of the first and of the second series
  double lag_s = 0.0;         // to be added to the times of the second
  double sigma_s = 0.0;
  double correlation = 0.0;  // of the two at that lag, where rows of both stand
};

// Of the pairs of columns that show the same: of one name, both speeds, a speed and a load, both of the room, both of
// the coolant. Each pair is compared where both have values, the second moved by lags up to `range_s` either way and
// scaled by least squares; the pair of the largest correlation is taken. Nullopt where there is no such pair, where
// none correlates by 0.7, or where a lag elsewhere fits nearly as well: two clocks that nothing tells apart.
//
// sigma: of the least sum of squares in the lag, readings that depend on each other counted as fewer. A quantity that
// changes in steps between the rows tells no more than their distance, since the steps of a programme may all lie at
// one place between them: sigma is at least the distance over the square root of 12. O(lags n), n at most 4000 rows.
std::optional<ClockLag> clock_lag(const Series& first, const Series& second, double range_s);

}  // namespace ballbar
