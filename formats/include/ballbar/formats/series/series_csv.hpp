// Series `.csv`: signals, drift, five probes. First column time_s or time_min; other names end in a unit.
//
// Under `# [five_probe]` a header may state spacing_mm, plane_1_from_nose_mm, resolution_um, linearity_percent, and the
// column of a probe if it is not X1_um, X2_um, Y1_um, Y2_um, Z_um: `# X1 = "ch1_um"`.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "ballbar/series/series.hpp"

namespace ballbar {

// `name` is used in messages. An empty cell is a gap (NaN). Throws Error with name:line:column.
Series read_series(std::string_view bytes, std::string_view name);

// The text with its header. Numbers read back exactly; a gap is an empty cell.
std::string write_series(const Series& series);

// The same in parts, for a long series: the header with the line of names, and rows [begin, end).
std::string series_header(const Series& series);
std::string write_rows(const Series& series, std::size_t begin, std::size_t end);

// Writes to a file completely or not at all. Throws Error, for instance without disk space.
void write_series(const Series& series, const std::filesystem::path& path);

// Writes the header and all rows in parts, so that the text of a long series is never in memory as a whole. An error
// may leave an incomplete file; use write_through() to avoid that. Throws Error, for instance without disk space.
void write_series_parts(const Series& series, std::string_view header, const std::filesystem::path& path);

}  // namespace ballbar
