// What an operator does before, during and after a test: plain text, to be printed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/formats/schedules/spindle_program.hpp"

namespace ballbar {

// Times are hours and minutes of the schedule: stops and ballbar tests put them off. `columns_to_log`: names of columns
// of a series, which end in their unit. Title and columns may hold any UTF-8 text; control characters in them are
// blanks. Throws Error as spindle_program.
std::string check_list(const Schedule& schedule, const ProgramOptions& options,
                       const std::vector<std::string>& columns_to_log, std::string_view title);

}  // namespace ballbar
