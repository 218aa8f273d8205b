// The program without the process that it runs in: `ballbar` on a terminal, and again and again in a page.
#pragma once

#include <string>
#include <vector>

namespace ballbar {

// Runs `ballbar WORDS...`; results go to the standard output, remarks and faults to standard error.
// Returns the exit status: 0 done, 1 the input is at fault, 2 the command line is at fault.
int program(const std::vector<std::string>& words);

}  // namespace ballbar
