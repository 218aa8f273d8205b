// The check list of an operator before, during and after a test: plain text, to be printed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/formats/schedules/spindle_program.hpp"

namespace ballbar {

// Times are hours and minutes of the schedule; stops and ballbar tests delay them. `columns_to_log`: names of columns
// of a series, with their units. Title and columns may have any UTF-8 text; control characters become blanks. Throws
// Error as spindle_program() does.
std::string check_list(const Schedule& schedule, const ProgramOptions& options,
                       const std::vector<std::string>& columns_to_log, std::string_view title);

}  // namespace ballbar
