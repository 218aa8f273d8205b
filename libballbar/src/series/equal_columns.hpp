// Columns that measure the same quantity: no data can tell which of them drives an effect.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace ballbar {

// other = offset + slope * column
struct LinearRelation {
  double offset = 0.0, slope = 1.0;
};

// The relation of two columns of one unit that measure the same quantity, as two sensors in one place. The slope is
// within 0.9 and 1.1. What remains is at most a step of the coarser one, or white: von Neumann's ratio (1941, Ann.
// Math. Stat. 12, 367) of the remainder and of its means over 2, 4, 8 ... neighbours is within 4 sigma. One does not
// lag the other: the coefficient of the remainder on the rate of change is zero within 4 sigma, and sigma is below half
// a row. `rows`: for which a logger holds a value. nullopt: they do not, a lag cannot be excluded, there are fewer than
// 48 values, or one has no value where the other has one.
std::optional<LinearRelation> equal_columns(const std::vector<double>& column, const std::vector<double>& other,
                                            std::size_t rows = 1);

}  // namespace ballbar
