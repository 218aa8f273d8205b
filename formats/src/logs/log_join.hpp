// Columns of one log beside those of another, row by row.
#pragma once

#include <string>

#include "ballbar/formats/logs/log.hpp"

namespace ballbar {

// Adds the columns of `beside` to the log. `name` and `file`: theirs, for messages. Throws Error where either has lines
// without a row of numbers, or the numbers of rows differ by more than a tenth.
void join(Log& log, const std::string& name, Log beside, const std::string& file);

// Sets the clock of a series later by what the recipe states for the file `name`; returns a sentence, empty where that
// is nothing. Throws Error for rows without a clock.
std::string shift_clock(Series& series, const LogRecipe& recipe, const std::string& name);

}  // namespace ballbar
