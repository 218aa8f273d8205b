// Recognises temperatures without a unit by their names and values.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "logs/log_plan.hpp"

namespace ballbar {

struct TemperatureFamily {
  std::vector<std::size_t> columns;  // of the plan; at least one
  std::string text;                  // "T0 to T15: temperatures by name and values, degC"
};

// Numeric columns without a unit whose values lie between 5 and 90 and change slowly, and whose name is that of a
// temperature or a machine part, or one of at least three names that differ in a number. `values`: one per column of
// the plan.
std::vector<TemperatureFamily> temperatures_among(const LogPlan& plan, const std::vector<std::vector<double>>& values);

}  // namespace ballbar
