// Finds the columns of a log with the time, and their format.
#pragma once

#include <string>
#include <vector>

#include "logs/column_sample.hpp"
#include "logs/log_plan.hpp"

namespace ballbar {

// Tries time stamps first, then a date and a time, then numbers, else the interval stated above the table. Sets the
// time of the plan and the kinds of its columns. Throws Error with name:line if there is no time.
void find_time(const LogShape& shape, const std::string& name, const LogRecipe& recipe,
               const std::vector<ColumnSample>& samples, LogPlan& plan);

}  // namespace ballbar
