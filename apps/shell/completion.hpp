// `ballbar completion bash|zsh|fish` prints what makes that shell complete commands, options, effects and files.
#pragma once

#include <string>
#include <vector>

#include "shell/command_words.hpp"

namespace CLI {
class App;
}

namespace ballbar {

std::string bash_completion(const std::vector<CommandWords>& commands);
std::string zsh_completion(const std::vector<CommandWords>& commands);
std::string fish_completion(const std::vector<CommandWords>& commands);

void add_completion_command(CLI::App& app);

}  // namespace ballbar
