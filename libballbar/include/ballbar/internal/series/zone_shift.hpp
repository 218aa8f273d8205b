// Whether the dates of two logs may be of different time zones, from columns that change together.
#pragma once

#include <optional>
#include <string>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct ZoneShift {
  std::string column, other;     // columns of the first and the second series
  double shift_s = 0.0;          // add this to the times of the second series
  double correlation = 0.0;      // of the changes of both columns, with the shift
  double correlation_now = 0.0;  // and without
};

// Shifts the second series by up to +-14 h in steps of 15 min, as time zones and summer time do, and compares the
// changes of two temperatures, or of two columns with the same name, role of speed or role of load, over 5 min, 15 min
// or 1 h. Changes, because levels of two temperatures that drift for a day are alike at many shifts. The score of a
// shift is Fisher's z of the correlation in its standard deviations, for the number of independent changes by
// Bartlett's formula; temperatures count only if they rise together. Returns the best shift if its score is at least 6
// and 1.5 times every score beyond its peak, and the peak does not hold 0; a whole hour goes before the other quarters
// if its score is nearly as large. One temperature may follow another with a delay, so that of two names only a peak at
// a whole or half hour counts. With no more than 300 pairs of columns; O(pairs shifts n).
std::optional<ZoneShift> zone_shift(const Series& first, const Series& second);

}  // namespace ballbar
