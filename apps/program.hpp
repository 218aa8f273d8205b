// The program without the process that it runs in: `ballbar` on a terminal, and again and again in a page.
#pragma once

#include <string>
#include <vector>

#include "ballbar/error.hpp"

namespace ballbar {

// The command line is at fault.
class UsageError : public Error {
 public:
  using Error::Error;
};

// Runs `ballbar WORDS...`; who takes what it says: terminal/caller.hpp. Throws UsageError, Error, or what else ended
// it, such as std::bad_alloc.
void run_command(const std::vector<std::string>& words);

// The same of a process of its own: results go to the standard output, remarks and faults to standard error.
// Returns the exit status: 0 done, 1 the input is at fault, 2 the command line is at fault.
int program(const std::vector<std::string>& words);

}  // namespace ballbar
