// Series `.csv`: signals, drift, five probes. First column time_s or time_min; other names end in a unit.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/series.hpp"

namespace ballbar {

// `name` stands in messages. An empty cell is a gap (NaN). Throws Error with name:line:column.
Series read_series(std::string_view bytes, std::string_view name);

// With its header; reads back to the same doubles; a gap is an empty cell.
std::string write_series(const Series& series);

}  // namespace ballbar
