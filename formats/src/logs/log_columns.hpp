// The columns of a series from those of a log: names, units, roles.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "ballbar/formats/logs/log.hpp"
#include "logs/log_plan.hpp"

namespace ballbar {

// One unit for all lengths that state none: mm where one of them drifts by so little that it can be no other. Returns
// what is assumed; empty: nothing.
std::string take_mm(LogPlan& plan, const std::vector<std::vector<double>>& values);

// Adds one column of numbers to the log, in the units of a series. `why`: what told its unit, where nothing in the file
// did. `taken`: the names that the series has.
void take_column(const PlannedColumn& planned, std::vector<double>&& values, const std::string& why,
                 const std::string& name, Log& log, std::set<std::string>& taken);

}  // namespace ballbar
