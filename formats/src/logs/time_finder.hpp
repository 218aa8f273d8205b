// Which columns of a log tell the time, and how.
#pragma once

#include <string>
#include <vector>

#include "logs/column_sample.hpp"
#include "logs/log_plan.hpp"

namespace ballbar {

// Stamps first, then a date and a clock, then numbers; else rows at the interval that the lines above the table state.
// Sets the plan's time and the kinds of its columns. Throws Error with name:line where none can be told.
void find_time(const LogShape& shape, const std::string& name, const LogRecipe& recipe,
               const std::vector<ColumnSample>& samples, LogPlan& plan);

}  // namespace ballbar
