// Units at the end of a column's name, and their conversion to those of a series.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ballbar/series/series.hpp"

namespace ballbar {

// A unit as loggers and people write it: "°C", "C", "degF", "mm", "1/min". canonical = factor value + offset.
struct ColumnUnit {
  std::string canonical;  // as the name of a column ends: "um", "degC", "rpm"
  double factor = 1.0, offset = 0.0;
};
std::optional<ColumnUnit> column_unit(std::string_view unit);  // nullopt: no unit of the list

// A name that ends in a unit of the list, with the unit of a series: "T_room_degF" as T_room_degC. nullopt: the name
// ends in a unit of a series already, such as "x_mm", or in none.
struct RenamedColumn {
  std::string name;
  ColumnUnit unit;
};
std::optional<RenamedColumn> in_unit_of_series(std::string_view name);

// A length in another unit than um, such as "z_mm" or "z_m", and its sigma, as the same in um under the name z_um; the
// column remembers its name. nullopt: another quantity, or um.
std::optional<RenamedColumn> in_um(std::string_view name);

}  // namespace ballbar
