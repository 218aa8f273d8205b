// Writes a schedule as a plain program of ISO 6983: the spindle turns (M3), rests (M5) and dwells (G4), the program
// stops (M0) for the operator. No axis moves.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ballbar/diagnosis/next_test/plan.hpp"

namespace ballbar {

// Controls differ in the word and the unit of G4; here it is P in seconds. So the program begins with a dwell of 10 s
// at rest and a stop: the operator times it by a watch. The schedule follows. The program stops wherever load, room or
// coolant are to be set; the spindle is at rest at every stop.
//
// Speeds are whole rpm. Times are whole milliseconds on the clock of the schedule, so that rounding errors do not add
// up. Dwells are split into blocks of at most 5 minutes, each with a comment of the minutes passed. The text is ASCII
// in capitals; of the title all characters but letters, digits and "+-.,=" become blanks. Throws Error as
// expect_schedule() does, and for a speed above max_rpm.
std::string iso_program(const Schedule& schedule, std::string_view title, std::optional<double> max_rpm = {});

}  // namespace ballbar
