// The program without the process that it runs in: `ballbar` on a terminal, and again and again in a page.
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

// The command line is at fault.
class UsageError : public Error {
 public:
  using Error::Error;
};

// A command as another program calls it.
struct CommandCall {
  // A flag: whether it is set; else the values, as on a command line.
  using Value = std::variant<bool, std::vector<std::string>>;

  std::string command;                                 // "check"
  std::vector<std::string> places;                     // DATA ..., as on a command line
  std::vector<std::pair<std::string, Value>> options;  // by their names: "max_gap"
  std::map<std::string, Source> values;                // data that a word stands for, which would else be a path
  Catalogue catalogue = built_in_catalogue();          // of effects, where a command takes models
};

// Runs it. Throws as below.
void run_command(const CommandCall& call);

// Runs `ballbar WORDS...`; who takes what it says: terminal/caller.hpp. Throws UsageError, Error, or what else ended
// it, such as std::bad_alloc.
void run_command(const std::vector<std::string>& words);

// The program and its commands, with their options.
std::vector<CommandWords> words_of_commands();

// The same of a process of its own: results go to the standard output, remarks and faults to standard error.
// Returns the exit status: 0 done, 1 the input is at fault, 2 the command line is at fault.
int program(const std::vector<std::string>& words);

}  // namespace ballbar
