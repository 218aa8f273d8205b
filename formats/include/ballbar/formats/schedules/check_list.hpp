// The check list of an operator before, during and after a test: plain text, to be printed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"

namespace ballbar {

// What is to be set by hand where `now` follows `before`, "load 1.5 times that of the data, room +3 K"; empty: nothing.
std::string order_text(const Dwell& before, const Dwell& now);

// For the program of iso_program(). Times are hours and minutes of the schedule; stops and ballbar tests delay them.
// `columns_to_log`: names of columns of a series, with their units. Title and columns may have any UTF-8 text; control
// characters become blanks. Throws Error as expect_schedule() does.
std::string check_list(const Schedule& schedule, const std::vector<std::string>& columns_to_log,
                       std::string_view title);

}  // namespace ballbar
