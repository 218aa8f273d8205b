// Named columns over time: temperatures, speed, probe readings, a drift series.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// What a column stands for in a model. Where a file does not say, the unit decides: `_rpm` speed,
// `_degC` structure, `_um` and `_mm` measured, `_A` and `_W` load; anything else is an event.
enum class Role { structure, ambient, coolant, bearing, mean_point, housing, speed, load, event, measured };

struct Column {
  std::string name;  // ends in its unit: "T_air_degC"
  Role role = Role::structure;
  std::vector<double> values;  // one a row; a gap is NaN
};

// Rows in the order of time. five_probe_spacing_mm: distance of probe planes 1 and 2 where the series is
// a five-probe recording (columns X1_um, X2_um, Y1_um, Y2_um, Z_um) and the file states it.
struct Series {
  std::vector<double> time_s;  // strictly rising
  std::vector<Column> columns;
  std::optional<double> five_probe_spacing_mm;
};

// Unit at the end of a column's name ("um", "mm", "degC", "rpm", "A", "W", "K"), empty if there is none.
std::string_view unit_of(std::string_view column_name);

Role role_from_unit(std::string_view unit);
std::string_view name_of(Role role);
std::optional<Role> role_from_name(std::string_view name);

// The column of that name, or nullptr.
const Column* find_column(const Series& series, std::string_view name);

}  // namespace ballbar
