// Where the names of the columns stand: above them, beside each value, or nowhere, as in lists of points.
#pragma once

#include <string>
#include <vector>

#include "logs/log_header.hpp"
#include "logs/log_shape.hpp"

namespace ballbar {

inline constexpr double kExplained = 0.95;  // of the rows: what a layout must explain

// The layouts of a table, each a recogniser of the same rows:
//
//   values beside their names   "T1 20.1 T2 22.3"; the names are the same in all rows
//   points                      "group, name, 1, x, y, z" without names above: X, Y, Z
//   table                       all others, with the names above the rows or none
//
// Rows of channels below each other are a table as well until their times are known (log_channels.hpp). Sets names,
// units and preamble of the shape, whose rows are known. Throws Error with name:line where two layouts fit.
void find_names(const std::string& name, const std::vector<HeadLine>& lines, const Cut& cut, LogShape& shape);

}  // namespace ballbar
