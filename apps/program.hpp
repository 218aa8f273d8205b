// The program without its process: `ballbar` runs once on a terminal, and repeatedly in a page.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/text/source.hpp"
#include "shell/command_words.hpp"

namespace ballbar {

// An error in the command line.
class UsageError : public Error {
 public:
  using Error::Error;
};

// A call of a command by another program.
struct CommandCall {
  // bool: a flag; else the values as on a command line.
  using Value = std::variant<bool, std::vector<std::string>>;

  std::string command;                                 // "check"
  std::vector<std::string> places;                     // DATA ..., as on a command line
  std::vector<std::pair<std::string, Value>> options;  // by their names: "max_gap"
  std::map<std::string, Source> values;                // data by name; other words are paths
  Catalogue catalogue = built_in_catalogue();          // effects for commands with models
};

// Runs the call. Throws as the function below.
void run_command(const CommandCall& call);

// Runs `ballbar WORDS...`; for the output see terminal/caller.hpp. Returns the exit status, 0 or 3. Throws UsageError,
// Error, or what else ended it, such as std::bad_alloc.
int run_command(const std::vector<std::string>& words);

// The program and its commands, with their options.
std::vector<CommandWords> words_of_commands();

// The same as a process: results go to the standard output, remarks and errors to standard error.
// Returns the exit status: 0 success, 1 error in the input, 2 error in the command line, 3 a ballbar test fails
// its tolerance.
int program(const std::vector<std::string>& words);

}  // namespace ballbar
