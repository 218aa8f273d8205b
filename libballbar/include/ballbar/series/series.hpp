// Named columns over time: temperatures, speed, probe readings, a drift series.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// The role of a column in a model. Unless the file states it, the unit decides: `_rpm` speed,
// `_degC` structure, `_um`, `_mm` and `_urad` measured, `_A`, `_W`, `_Nm` and `_percent` load; anything else is an
// event.
enum class Role { structure, ambient, coolant, bearing, mean_point, housing, speed, load, event, measured };

struct Column {
  std::string name;  // ends in its unit: "T_air_degC"
  Role role = Role::structure;
  std::vector<double> values;  // one a row; a gap is NaN
  std::string header = {};     // as its file writes the name; empty: as `name`
};

// Five probes on a bar in the spindle (ISO 230-3 layout): what a file or a user states about them. Plane 1 is
// the one near the spindle's nose, plane 2 the other.
inline constexpr std::array<std::string_view, 5> kProbes{"X1", "X2", "Y1", "Y2", "Z"};
struct FiveProbe {
  std::optional<double> spacing_mm;            // distance of planes 1 and 2
  std::optional<double> plane_1_from_nose_mm;  // distance of plane 1 from the spindle's nose
  std::optional<double> resolution_um;         // the smallest step of a reading
  std::optional<double> linearity_percent;     // limit of the probe's error, percent of the reading
  std::array<std::string, 5> columns{"X1_um", "X2_um", "Y1_um", "Y2_um", "Z_um"};  // of the series, as kProbes
};

// How a run began: at rest in thermal equilibrium, or still warm from earlier work.
enum class RunStart { rest, warm };

// One of several runs.
struct RunOrigin {
  std::string name;  // of its file
  RunStart start = RunStart::rest;
};

// Rows in the order of time.
struct Series {
  std::vector<double> time_s;  // strictly rising; with several runs (runs.hpp) within each
  std::vector<Column> columns;
  std::optional<FiveProbe> five_probe;  // from the file's [five_probe] table
  std::optional<std::string> started;   // wall clock at time_s = 0, "2026-11-22T13:05:10", no zone; nullopt: not known
  std::vector<RunOrigin> runs;          // one per run if there are several; else empty
  bool has_clock = true;                // false: no file states the time, and time_s numbers the rows 0, 1, 2 ...
};

// Unit at the end of a column's name ("um", "mm", "urad", "degC", "rpm", "A", "W", "K", "percent", "Nm", "bar",
// "l_per_min", "mm_per_min", "deg_per_min", "V"), empty if there is none.
std::string_view unit_of(std::string_view column_name);

Role role_from_unit(std::string_view unit);
std::string_view name_of(Role role);
std::optional<Role> role_from_name(std::string_view name);

// The column of that name, or nullptr.
const Column* find_column(const Series& series, std::string_view name);

std::vector<std::string> column_names(const Series& series);

// Whether a model could explain the column: it is measured, and not the sigma of another column.
bool is_target(const Column& column);

// The name, with a number before its unit if it is already in `taken`. Adds the result to `taken`.
std::string free_name(std::string_view name, std::set<std::string>& taken);

}  // namespace ballbar
