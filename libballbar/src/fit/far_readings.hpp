// Readings far from their neighbours, before any model is known (Hampel's identifier).
#pragma once

#include <cstddef>
#include <vector>

namespace ballbar {

// Rows, rising, of values more than 6 sigma off the running median of seven; sigma is the larger of 1.4826 times the
// median deviation and what the median change from value to value gives. A step or a steady drift has none. Fewer than
// twelve values, NaN not counted: none. O(n).
std::vector<std::size_t> far_readings(const std::vector<double>& readings);

}  // namespace ballbar
