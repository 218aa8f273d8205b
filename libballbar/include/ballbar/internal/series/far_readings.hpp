// Readings far from their neighbours, before any model is known.
#pragma once

#include <cstddef>
#include <vector>

namespace ballbar {

// Rows, rising, of one to three values in a row that are more than 10 sigma off the running median of seven (Hampel's
// identifier) and come back: the three values before and after them are all within a quarter of that. So a step, a
// ramp, a peak that decays, and the first or last value are none. sigma is the larger of 1.4826 times the median
// deviation and what the median change from value to value gives. Fewer than twelve values, NaN not counted: none.
// O(n).
std::vector<std::size_t> far_readings(const std::vector<double>& readings);

}  // namespace ballbar
