#include "model/known_effect.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "ballbar/nearest_name.hpp"
#include "shell/command_words.hpp"
#include "shell/usage_fault.hpp"

namespace ballbar {

void expect_known_effect(const std::string& word, bool or_file) {
  const std::string name = word.substr(0, word.find_first_of(":("));
  const std::vector<std::string> known = effect_words();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw CLI::ValidationError(fmt::format("expected an effect{}, found {}{}{}; ballbar effects lists all",
                                         or_file ? " or a file" : "", in_quotes(name),
                                         or_file ? ", which is neither" : "", nearest_hint(name, known)));
}

}  // namespace ballbar
