// Series `.csv`: signals, drift, five probes. First column time_s or time_min; other names end in a unit.
//
// Under `# [five_probe]` a header may state spacing_mm, plane_1_from_nose_mm, resolution_um, linearity_percent, and
// which column a probe's readings stand in where it is not X1_um, X2_um, Y1_um, Y2_um, Z_um: `# X1 = "ch1_um"`.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "ballbar/series/series.hpp"

namespace ballbar {

// `name` stands in messages. An empty cell is a gap (NaN). Throws Error with name:line:column.
Series read_series(std::string_view bytes, std::string_view name);

// With its header; reads back to the same doubles; a gap is an empty cell.
std::string write_series(const Series& series);

// The same in parts, for a long series: up to the line of names, then rows [begin, end).
std::string series_header(const Series& series);
std::string write_rows(const Series& series, std::size_t begin, std::size_t end);

// To a file, whole or not at all. Throws Error where there is no room.
void write_series(const Series& series, const std::filesystem::path& path);

// The header and all rows to a file, in parts, so that a long series is not in memory a second time as text. The file
// may be left half written: write_through writes it beside first. Throws Error where there is no room.
void write_series_parts(const Series& series, std::string_view header, const std::filesystem::path& path);

}  // namespace ballbar
