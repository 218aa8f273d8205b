// Temperatures without a unit: by their names and by how they behave.
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

// Columns of numbers without a unit whose values lie in 5 to 90 and move slowly, and that are named as a temperature or
// as a part of a machine, or stand in a family of at least three names that differ in a number. `values`: one a column
// of the plan.
std::vector<TemperatureFamily> temperatures_among(const LogPlan& plan, const std::vector<std::vector<double>>& values);

}  // namespace ballbar
