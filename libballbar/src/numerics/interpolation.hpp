// Straight lines between the rows of a column.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace ballbar {

// At row + share of the way to the next row; share 0: on the row.
struct Place {
  std::size_t row = 0;
  double share = 0.0;
};

// Nothing outside [front, back]. O(log n).
std::optional<Place> place_of(std::span<const double> time_s, double at_s);

// NaN where a row that is needed is NaN.
double value_at(std::span<const double> column, const Place& place);

}  // namespace ballbar
