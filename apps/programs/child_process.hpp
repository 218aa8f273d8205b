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

// `arguments`: the program, found on PATH, and what it is called with. The environment is the caller's but for
// variables that begin with `without`. Throws Error, beginning with `option`: no room for its input, or it could not be
// started for another reason than that it is not there.
ChildProcess child_process(const std::string& option, const std::vector<std::string>& arguments, std::string_view in,
                           std::string_view without = {});

// Starts it and does not wait: a viewer, which goes on when we have ended. False where there is no such program.
bool started(const std::vector<std::string>& arguments);

}  // namespace ballbar
