// Recognises temperatures by their units, or without one by their names and values.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "logs/log_plan.hpp"
#include "logs/log_units.hpp"

namespace ballbar {

struct TemperatureFamily {
  std::vector<std::size_t> columns;  // of the plan; at least one
  std::string text;                  // "T0 to T15: temperatures by name and values, degC"
};

// Numeric columns without a unit whose values lie between 5 and 90 and change slowly, up to 350 where a
// name says so and the least is below 45, and whose name is that of a
// temperature or a machine part, or one of at least three names that differ in a number. `values`: one per column of
// the plan.
std::vector<TemperatureFamily> temperatures_among(const LogPlan& plan, const std::vector<std::vector<double>>& values);

// To degC: of a column that is a temperature by its unit, or by its name where it has none. Not of one that is stated
// to be measured or an event.
std::optional<LogUnit> temperature_unit(const PlannedColumn& column);

// "Room F": F alone may be a part of the name. It becomes the unit of a room that would be above 45 degC, and of other
// temperatures beside one in degrees Fahrenheit.
void take_fahrenheit(LogPlan& plan, const std::vector<std::vector<double>>& values);

// One scale for all temperatures that state no unit: degF or K where they begin at a room's temperature in that scale
// alone. Returns what is assumed; empty: degC, or the values do not tell.
std::string take_scale(LogPlan& plan, const std::vector<std::vector<double>>& values);

}  // namespace ballbar
