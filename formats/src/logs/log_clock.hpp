// A logger's clock as seconds that rise.
#pragma once

#include <string>
#include <vector>

#include "logs/log_plan.hpp"
#include "logs/log_table.hpp"

namespace ballbar {

// Stamps and numbers of the table as seconds: of a date or a clock from the first row, else as they are. Runs on over
// midnight where there is no date, over the hour that summer time takes or gives; spreads rows of one stamp evenly to
// the next. What was done is said in `remarks`. `started` becomes the wall clock of the first row where a date stands.
// Throws Error with name:line where the time runs back otherwise.
std::vector<double> clock_s(LogTable& table, const LogPlan& plan, const std::string& name,
                            std::optional<double>& started_s, std::vector<std::string>& remarks);

}  // namespace ballbar
