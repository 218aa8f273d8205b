// The slope of a curve at its rows.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace ballbar {

struct Slopes {
  std::vector<double> per_s, variance;  // n rows
};

// Of the parabola (least squares) through the rows around each, 3 of them or 1/30 of all, at most 101. Nothing: fewer
// than 5 rows, or the parabolas do not follow the rows: their slopes leave more than a tenth (of the squares) of the
// steps from row to row, scatter of `variance` set aside.
std::optional<Slopes> slopes_of_rows(std::span<const double> time_s, std::span<const double> value,
                                     std::span<const double> variance);

}  // namespace ballbar
