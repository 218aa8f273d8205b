#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shell/command_words.hpp"

namespace ballbar {
namespace {

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::vector<std::string> all_names(const CommandWords& command) {
  std::vector<std::string> names;
  for (const OptionWords& option : command.options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// The variables of the shell function: words to offer, and whether files or folders too.
std::string offers(Takes takes, const std::vector<std::string>& words) {
  switch (takes) {
    case Takes::words:
      return fmt::format("offered='{}'", joined(words));
    case Takes::file:
      return "paths=files";
    case Takes::folder:
      return "paths=folders";
    case Takes::effect:
      return "offered=$effects";
    case Takes::effect_or_file:
      return "offered=$effects paths=files";
    default:
      return ":";
  }
}

std::string offers_of_places(const CommandWords& command) {
  if (!command.commands.empty()) {
    return fmt::format("offered='{}'{}", joined(command.commands),
                       command.path.empty() || !command.places.empty() ? " paths=files" : "");
  }
  std::string all;
  for (const OptionWords& place : command.places) {
    const std::string one = offers(place.takes, place.words);
    if (one != ":" && all.find(one) == std::string::npos) all += (all.empty() ? "" : " ") + one;
  }
  return all;
}

// Which command the words before belong to, what an option's value may be, and which options and places there are: the
// three `case` of the script.
std::string path_cases(const std::vector<CommandWords>& commands) {
  std::string cases;
  for (const CommandWords& command : commands) {
    if (command.path.empty()) continue;
    const std::size_t last = command.path.rfind(' ');
    const std::string before = last == std::string::npos ? "" : command.path.substr(0, last);
    cases += fmt::format("      '{}/{}') command='{}' ;;\n", before,
                         command.path.substr(last == std::string::npos ? 0 : last + 1), command.path);
  }
  return cases;
}

std::string value_cases(const std::vector<CommandWords>& commands) {
  std::string cases;
  for (const CommandWords& command : commands) {
    for (const OptionWords& option : command.options) {
      if (option.takes == Takes::nothing) continue;
      for (const std::string& name : option.names) {
        cases += fmt::format("    '{}:{}') is_value=1 {} ;;\n", command.path, name,
                             option.takes == Takes::text ? "" : offers(option.takes, option.words));
      }
    }
  }
  return cases;
}

std::string command_cases(const std::vector<CommandWords>& commands) {
  std::string cases;
  for (const CommandWords& command : commands) {
    cases += fmt::format("    '{}') options='{}' {} ;;\n", command.path, joined(all_names(command)),
                         offers_of_places(command));
  }
  return cases;
}

}  // namespace

std::string bash_completion(const std::vector<CommandWords>& commands) {
  return fmt::format(
      R"(# Completion of ballbar in bash, printed by `ballbar help --completion bash`.
_ballbar() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command= options= offered= paths= is_value= i
  local effects='{}'
  # --name=value comes as three words.
  if [ "$word" = = ]; then
    word=
  elif [ "$before" = = ]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case $command/${{COMP_WORDS[i]}} in
{}      /-*) ;;
      /*) break ;;
    esac
  done
  case $command:$before in
{}  esac
  if [ -z "$is_value" ]; then
    case $command in
{}    esac
    case $word in
      -*) offered=$options paths= ;;
    esac
  fi
  COMPREPLY=()
  if [ -n "$offered" ]; then mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word"); fi
  if [ -n "$paths" ]; then
    local kind=-f found
    if [ "$paths" = folders ]; then kind=-d; fi
    mapfile -t found < <(compgen $kind -- "$word")
    COMPREPLY+=("${{found[@]}}")
    compopt -o filenames 2> /dev/null
  fi
  return 0
}}
complete -F _ballbar ballbar
)",
      joined(effect_words()), path_cases(commands), value_cases(commands), command_cases(commands));
}

}  // namespace ballbar
