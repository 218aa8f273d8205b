// The slope of a curve at its rows.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace ballbar {

struct Slopes {
  std::vector<double> per_s, variance;  // n rows
};

// The slope of a least squares parabola through the rows around each row: 3 rows or 1/30 of all, at most 101. Returns
// nullopt for fewer than 5 rows, or if the parabolas do not fit: their slopes leave more than a tenth of the sum of
// squares of the steps from row to row, after subtracting the scatter of `variance`.
std::optional<Slopes> slopes_of_rows(std::span<const double> time_s, std::span<const double> value,
                                     std::span<const double> variance);

}  // namespace ballbar
