// Converts the clock of a logger to rising seconds.
#pragma once

#include <string>
#include <vector>

#include "logs/log_plan.hpp"
#include "logs/log_table.hpp"

namespace ballbar {

// The time stamps and numbers of the table as seconds: dates and times count from the first row, numbers stay.
// Continues over midnight if there is no date, and over changes of summer time. Spreads rows with the same stamp evenly
// up to the next one. Adds remarks. Sets `started` to the wall clock of the first row if there is a date. Throws Error
// with name:line if the time goes back otherwise.
std::vector<double> clock_s(LogTable& table, const LogPlan& plan, const std::string& name,
                            std::optional<double>& started_s, std::vector<std::string>& remarks);

}  // namespace ballbar
