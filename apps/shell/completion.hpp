// What makes a shell complete commands, options, effects and files: `ballbar help --completion bash|zsh|fish`.
#pragma once

#include <string>
#include <vector>

#include "shell/command_words.hpp"

namespace ballbar {

std::string bash_completion(const std::vector<CommandWords>& commands);
std::string zsh_completion(const std::vector<CommandWords>& commands);
std::string fish_completion(const std::vector<CommandWords>& commands);

}  // namespace ballbar
