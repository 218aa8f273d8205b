// Lines of `complete` for fish, which shows what each word is for.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shell/command_words.hpp"

namespace ballbar {
namespace {

std::string quoted(const std::string& text) {
  std::string inside;
  for (const char letter : text)
    inside += letter == '\'' || letter == '\\' ? std::string{'\\', letter} : std::string{letter};
  return "'" + inside + "'";
}

std::string at(const CommandWords& command) {
  return fmt::format("complete -c ballbar -n {}", quoted(fmt::format("__ballbar_is \"{}\"", command.path)));
}

std::string offered(Takes takes, const std::vector<std::string>& words) {
  switch (takes) {
    case Takes::words:
      return fmt::format(" -x -a {}", quoted(fmt::format("{}", fmt::join(words, " "))));
    case Takes::file:
      return " -r -F";
    case Takes::folder:
      return " -x -a '(__fish_complete_directories)'";
    case Takes::effect:
      return " -x -a '$__ballbar_effects'";
    case Takes::effect_or_file:
      return " -r -F -a '$__ballbar_effects'";
    default:
      return " -x";
  }
}

std::string lines_of(const CommandWords& command, const std::vector<CommandWords>& all) {
  std::string lines;
  for (const CommandWords& next : all) {
    const std::string before = command.path.empty() ? "" : command.path + " ";
    const std::string name = next.path.starts_with(before) ? next.path.substr(before.size()) : "";
    if (name.empty() || name.find(' ') != std::string::npos) continue;
    lines += fmt::format("{} -a {} -d {}\n", at(command), name, quoted(next.summary));
  }
  if (command.path.empty()) lines += at(command) + " -F\n";
  for (const OptionWords& place : command.places) {
    if (place.takes == Takes::text) continue;
    const std::string what = offered(place.takes, place.words);
    lines += at(command) + (what.starts_with(" -r") ? what.substr(3) : what) + "\n";
  }
  for (const OptionWords& option : command.options) {
    lines += at(command);
    for (const std::string& name : option.names) {
      lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (option.takes != Takes::nothing) lines += offered(option.takes, option.words);
    lines += fmt::format(" -d {}\n", quoted(option.help));
  }
  return lines;
}

}  // namespace

std::string fish_completion(const std::vector<CommandWords>& commands) {
  std::string cases, lines;
  for (const CommandWords& command : commands) {
    lines += lines_of(command, commands);
    if (command.path.empty()) continue;
    const std::size_t last = command.path.rfind(' ');
    const bool first = last == std::string::npos;
    cases += fmt::format("      case '{}/{}'\n        set command '{}'\n", first ? "" : command.path.substr(0, last),
                         command.path.substr(first ? 0 : last + 1), command.path);
  }
  return fmt::format(R"(# Completion of ballbar in fish, printed by `ballbar help --completion fish`.
function __ballbar_is
  set -l command ''
  set -l words (commandline -opc)
  for word in $words[2..-1]
    switch "$command/$word"
{}      case '/-*'
      case '/*'
        break
    end
  end
  test "$command" = "$argv[1]"
end
set -g __ballbar_effects {}
complete -c ballbar -f
{})",
                     cases, fmt::join(effect_words(), " "), lines);
}

}  // namespace ballbar
