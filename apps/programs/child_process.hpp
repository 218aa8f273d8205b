// A program run to its end, with text in and text out: no shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

struct ChildProcess {
  bool not_found = false;
  int signal = 0;  // that ended it; 0: none
  int status = 0;
  std::string out, err;
};

// `arguments`: the program, found on PATH, and its arguments. The environment is that of the caller, without variables
// that begin with `without`. Throws Error, beginning with `option`, if its input cannot be stored, or if an existing
// program cannot be started.
ChildProcess child_process(const std::string& option, const std::vector<std::string>& arguments, std::string_view in,
                           std::string_view without = {});

// Starts a program without waiting: a viewer that outlives this process. Returns false if the program does not exist.
bool started(const std::vector<std::string>& arguments);

}  // namespace ballbar
