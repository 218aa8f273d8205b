// The commands and their options for completions and for functions in Python, from the command line parser of the
// program.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ballbar {

// An option or a positional argument of the command line.
enum class Takes { nothing, text, words, file, folder, effect, effect_or_file };

struct OptionWords {
  std::vector<std::string> names;  // "-h", "--help"; of a place its one name, without dashes
  std::string value;               // as the help shows it: "MM", empty of a flag
  std::string help;
  Takes takes = Takes::nothing;
  std::vector<std::string> words;  // that it takes, where these are few
  bool is_required = false;
  bool is_many = false;
};

struct CommandWords {
  std::string path;  // "simulate score", empty of the program itself
  std::string summary;
  std::vector<OptionWords> places, options;
  std::vector<std::string> commands;  // the next words
};

// The program itself, then its commands, each before its own.
std::vector<CommandWords> command_words(const CLI::App& app);

// Of both levels, each once.
std::vector<std::string> effect_words();

// The script for commands, options, effects and files: `ballbar help --completion bash`.
std::string bash_completion(const std::vector<CommandWords>& commands);

}  // namespace ballbar
