#include "shell/usage_fault.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "ballbar/internal/nearest_name.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar {
namespace {

const CLI::App& chosen_app(const CLI::App& app) {
  const CLI::App* chosen = &app;
  while (!chosen->get_subcommands().empty()) chosen = chosen->get_subcommands().front();
  return *chosen;
}

// "--out" of "--out=drift.csv".
std::string option_in(const std::string& word) { return word.substr(0, word.find('=')); }

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options([](const CLI::Option* one) { return !one->get_group().empty(); })) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// A word that no option and no place is for; an option rather than what follows it.
std::string surplus_of(const CLI::App& app) {
  std::vector<std::string> words = app.remaining();
  std::erase(words, "--");  // behind it stand places
  const auto option = std::find_if(words.begin(), words.end(), is_option);
  if (option != words.end()) return *option;
  return words.empty() ? "" : words.front();
}

std::string option_fault(const CLI::App& app, const std::string& found) {
  return fmt::format("expected an option of {}, found {}{}", full_name(app), option_in(found),
                     nearest_hint(option_in(found), option_names(app)));
}

// Where a command is to stand and none does.
std::string command_fault(const CLI::App& app, const std::string& found) {
  const bool first = app.get_parent() == nullptr;
  const char* const expected = first ? "a command or a file" : "a command";
  if (found.empty()) return fmt::format("expected {}, found none", expected);
  if (is_option(found)) return option_fault(app, found);
  const std::string hint = nearest_hint(found, command_names(app));
  return first ? fmt::format("{} is neither a command nor a file{}", in_quotes(found), hint)
               : fmt::format("expected {}, found {}{}", expected, in_quotes(found), hint);
}

std::string fault(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const std::string surplus = surplus_of(app);
  const bool is_of_a_value = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr;
  if (app.get_require_subcommand_min() > 0 && !is_of_a_value) {
    return command_fault(app, app.get_parent() == nullptr && !words.empty() ? words.front() : surplus);
  }
  if (is_option(surplus) && !is_of_a_value) return option_fault(app, surplus);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !surplus.empty()) {
    return fmt::format("expected nothing more, found {}", in_quotes(surplus));
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) return exclusion_text(app);
  std::string text = error.what();
  while (text.ends_with('.')) text.pop_back();
  return text;
}

}  // namespace

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

std::string full_name(const CLI::App& app) {
  const CLI::App* const parent = app.get_parent();
  return parent == nullptr ? app.get_name() : full_name(*parent) + " " + app.get_name();
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::string nearest_hint(const std::string& found, const std::vector<std::string>& known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  const std::string_view nearest = near_name(found, views);
  return nearest.empty() ? "" : fmt::format("; the nearest is {}", nearest);
}

std::string usage_fault(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const CLI::App& chosen = chosen_app(app);
  return fmt::format("{}. See {} --help.", fault(chosen, error, words), full_name(chosen));
}

}  // namespace ballbar
