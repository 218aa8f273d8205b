#include "shell/command_words.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "ballbar/effects/effect.hpp"
#include "ballbar/model/model.hpp"
#include "shell/usage_fault.hpp"

namespace ballbar {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

// By the name of the place, or of the value: these are the same words in all commands.
Takes taken_by(const std::string& name) {
  if (name == "EFFECT" || name == "NAME") return Takes::effect;
  if (name == "EFFECT_AND_DATA") return Takes::effect_or_file;
  if (name == "DIR" || name == "FOLDER") return Takes::folder;
  for (const char* of_a_file : {"FILE", "DATA", "LOG", "SESSION", "MACHINE", "RUNS", "A", "B"}) {
    if (name == of_a_file) return Takes::file;
  }
  return Takes::text;
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  words.help = option.get_description();
  words.is_required = option.get_required();
  words.is_many = option.get_expected_max() > 1;
  const std::string type = option.get_type_name();
  if (type.find('|') != std::string::npos) words.words = split(type, '|');
  if (option.get_positional()) {
    words.names = {option.get_name(true, false)};
    words.takes = words.words.empty() ? taken_by(words.names.front()) : Takes::words;
    return words;
  }
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  if (option.get_expected_max() == 0 || option.get_type_size() == 0) return words;  // a flag
  words.value = type;
  words.takes = !words.words.empty() ? Takes::words
                : type == "NAME"     ? Takes::text
                                     : taken_by(type == "[FILE]" ? "FILE" : type);
  return words;
}

void add_words(const CLI::App& app, const std::string& path, std::vector<CommandWords>& all) {
  CommandWords words{path, app.get_description(), {}, {}, command_names(app)};
  for (const CLI::Option* option : app.get_options([](const CLI::Option* one) { return !one->get_group().empty(); })) {
    (option->get_positional() ? words.places : words.options).push_back(words_of(*option));
  }
  all.push_back(words);
  for (const CLI::App* next : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); })) {
    add_words(*next, path.empty() ? next->get_name() : path + " " + next->get_name(), all);
  }
}

}  // namespace

std::vector<CommandWords> command_words(const CLI::App& app) {
  std::vector<CommandWords> all;
  add_words(app, "", all);
  for (CommandWords& command : all) {  // help COMMAND
    for (OptionWords& place : command.places) {
      if (place.names.front() != "COMMAND") continue;
      place.takes = Takes::words;
      place.words = all.front().commands;
    }
  }
  return all;
}

std::vector<std::string> effect_words() {
  std::vector<std::string> names{expression_page().name};
  for (const auto& effect : built_in_catalogue()) names.push_back(effect->name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace ballbar
