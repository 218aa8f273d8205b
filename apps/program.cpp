#include "program.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "ballbar/internal/nearest_name.hpp"
#include "commands.hpp"
#include "shell/file_command.hpp"
#include "shell/help.hpp"
#include "shell/usage_fault.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"

namespace {

using AddCommand = void (*)(CLI::App&);

struct Command {
  const char* name;
  AddCommand add;
};

// Commands under a heading of the help.
struct Group {
  const char* heading;
  std::vector<Command> commands;
};

const std::vector<Group>& groups() {
  using namespace ballbar::commands;
  static const std::vector<Group> kGroups{
      {"Measure", {{"fit", add_fit}, {"drift", add_drift}, {"compare", add_compare}}},
      {"Import", {{"import", add_import}}},
      {"Monitor", {{"errors", add_errors}, {"history", add_history}}},
      {"Report", {{"report", add_report}}},
      {"Model", {{"effects", add_effects}, {"could", add_could}, {"check", add_check}}},
      {"Diagnose",
       {{"diagnose", add_diagnose}, {"plan", add_plan}, {"add", add_add}, {"undo", add_undo}, {"ledger", add_ledger}}},
      {"Predict", {{"train", add_train}, {"predict", add_predict}, {"compensate", add_compensate}}},
      {"Simulate", {{"simulate", add_simulate}}},
      {"Help", {{"help", ballbar::add_help_command}}}};
  return kGroups;
}

void add_commands(CLI::App& app) {
  for (const Group& group : groups()) {
    for (const Command& command : group.commands) {
      command.add(app);
      CLI::App* const added = app.get_subcommand(command.name);
      if (added->get_group() == "Subcommands") added->group(group.heading);
    }
  }
}

// One of them alone: setting up all takes longer than a small fit.
CLI::App& add_command(CLI::App& app, const std::string& name) {
  for (const Group& group : groups()) {
    for (const Command& command : group.commands) {
      if (command.name != name) continue;
      command.add(app);
      ballbar::expect_values(app);
      return *app.get_subcommand(name);
    }
  }
  throw ballbar::UsageError(fmt::format("expected a command, found {}.", ballbar::in_quotes(name)));
}

void set_option(CLI::App& command, const std::string& name, const ballbar::CommandCall::Value& value) {
  std::string word = "--" + name;
  std::replace(word.begin(), word.end(), '_', '-');
  CLI::Option* const option = command.get_option_no_throw(word);
  if (option == nullptr) {
    std::vector<std::string> known;
    for (const CLI::Option* one : command.get_options()) {
      for (std::string long_name : one->get_lnames()) {
        std::replace(long_name.begin(), long_name.end(), '-', '_');
        known.push_back(std::move(long_name));
      }
    }
    throw ballbar::UsageError(fmt::format("{}: expected an option of {}, found none of that name{}.", name,
                                          command.get_name(), ballbar::nearest_hint(name, known)));
  }
  const bool is_flag = option->get_items_expected_max() == 0;
  const bool* const flag = std::get_if<bool>(&value);
  if (is_flag != (flag != nullptr)) {
    const auto found = [&]() -> std::string {
      if (flag != nullptr) return *flag ? "True" : "False";
      const auto& words = std::get<std::vector<std::string>>(value);
      return words.empty() ? "none" : words.front();
    };
    throw ballbar::UsageError(
        fmt::format("{}: expected {}, found {}.", name, is_flag ? "True or False" : "a value", found()));
  }
  if (flag == nullptr) {
    option->add_result(std::get<std::vector<std::string>>(value));
  } else if (*flag) {
    option->add_result("true");
  }
}

// The program's options and commands.
void set_up(CLI::App& app) {
  app.name("ballbar");
  app.require_subcommand(1);
  ballbar::set_help(app);
  app.set_version_flag("--version", "ballbar " BALLBAR_VERSION, "print the version");
  ballbar::add_page_option(app);
  app.footer(
      "Without a command, ballbar FILE... runs errors on ballbar tests, drift on a session and diagnose on a "
      "series.\nballbar help COMMAND lists the main options of a command, with --details all of them.");
  add_commands(app);
  ballbar::expect_values(app);
}

}  // namespace

namespace ballbar {

void run_command(const CommandCall& call) {
  CommandLine app;
  app.name("ballbar");
  app.values = call.values;
  app.catalogue = call.catalogue;
  CLI::App& command = add_command(app, call.command);
  for (const auto& [name, value] : call.options) set_option(command, name, value);
  std::vector<std::string> line{call.command, "--"};
  line.insert(line.end(), call.places.begin(), call.places.end());
  try {
    std::reverse(line.begin(), line.end());  // as CLI11 takes them
    app.parse(std::move(line));
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_fault(app, error, {call.command}));
  }
}

int run_command(const std::vector<std::string>& words) {
  CommandLine app{"Compute thermal drift of machine tool spindles from ballbar logs."};
  set_up(app);
  try {
    std::vector<std::string> line = with_command(words, app);
    std::reverse(line.begin(), line.end());  // as CLI11 takes them
    app.parse(std::move(line));
  } catch (const CLI::CallForVersion& version) {
    fmt::print("{}\n", version.what());
  } catch (const CLI::Success&) {
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    print_help(help_of(*command, std::find(words.begin(), words.end(), "--details") != words.end()));
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_fault(app, error, words));
  }
  return app.status;
}

std::vector<CommandWords> words_of_commands() {
  CommandLine app;
  set_up(app);
  return command_words(app);
}

int program(const std::vector<std::string>& words) {
  int status = 0;
  try {
    status = run_command(words);
  } catch (const UsageError& error) {
    error_line(error.what());
    return 2;
  } catch (const std::exception& error) {  // Error; out of memory, a full disk
    error_line(error.what());
    return 1;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
    error_line(fmt::format("cannot write the results to standard output: {}", std::strerror(errno)));
    return 1;
  }
  return status;
}

}  // namespace ballbar
