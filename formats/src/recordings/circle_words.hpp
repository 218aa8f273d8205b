// Interprets the header of a circle table in several languages. All parts are optional.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "recordings/column_table.hpp"

namespace ballbar {

// What a column is called; `none`: nothing that is known.
enum class ColumnWord { none, time, number, angle, length, deviation, coordinate };
ColumnWord word_of(const NumberColumn& column);

// 0, 1, 2 of a coordinate X, Y, Z.
std::optional<int> axis_of(const NumberColumn& column);

// "X soll", "Y cmd": commanded, not measured coordinates.
bool is_commanded(const NumberColumn& column);

std::optional<Direction> direction_of(const NumberColumn& column);

std::optional<double> mm_per_unit(const NumberColumn& column);
std::optional<double> rad_per_unit(const NumberColumn& column);
std::optional<double> seconds_per_unit(const NumberColumn& column);

// "Radius: 50,000 mm", "Durchmesser 100"; "Feed 1000 mm/min", "F1000"; "Plane XZ", "G17".
std::optional<double> stated_radius_mm(const std::vector<std::string>& lines);
std::optional<double> stated_feed_mm_per_min(const std::vector<std::string>& lines);
std::optional<Plane> stated_plane(const std::vector<std::string>& lines);

}  // namespace ballbar
