#include "numerics/interpolation.hpp"

#include <algorithm>

namespace ballbar {

std::optional<Place> place_of(std::span<const double> time_s, double at_s) {
  if (time_s.empty() || at_s < time_s.front() || at_s > time_s.back()) return std::nullopt;
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), at_s);
  const auto row = static_cast<std::size_t>(after - time_s.begin()) - 1;
  if (after == time_s.end() || time_s[row] == at_s) return Place{row, 0.0};
  return Place{row, (at_s - time_s[row]) / (time_s[row + 1] - time_s[row])};
}

double value_at(std::span<const double> column, const Place& place) {
  if (place.share == 0.0) return column[place.row];
  return (1.0 - place.share) * column[place.row] + place.share * column[place.row + 1];
}

}  // namespace ballbar
