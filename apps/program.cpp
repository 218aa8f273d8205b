#include "program.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <iostream>
#include <string>
#include <vector>

#include "commands.hpp"
#include "shell/completion.hpp"
#include "shell/file_command.hpp"
#include "shell/help.hpp"
#include "shell/man_page.hpp"
#include "shell/usage_fault.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"

namespace {

using AddCommand = void (*)(CLI::App&);

// Commands under a heading of the help.
void add_group(CLI::App& app, const char* heading, std::initializer_list<AddCommand> commands) {
  for (const AddCommand add : commands) add(app);
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_group() == "Subcommands") command->group(heading);
  }
}

void add_commands(CLI::App& app) {
  using namespace ballbar::commands;
  add_group(app, "Measure", {add_fit, add_drift, add_compare});
  add_group(app, "Logs of others", {add_import, add_merge});
  add_group(app, "Follow", {add_errors, add_history, add_fleet});
  add_group(app, "Look", {add_report, add_page});
  add_group(app, "Model", {add_effects, add_terms, add_preflight, add_check});
  add_group(app, "Diagnose", {add_diagnose, add_plan, add_try, add_add, add_undo, add_ledger, add_inject});
  add_group(app, "Train", {add_train, add_select});
  add_group(app, "Predict", {add_predict});
  add_group(app, "Compensate", {add_compensate});
  add_group(app, "Place a sensor", {add_meanpoint});
  add_group(app, "Simulate", {add_simulate});
  add_group(app, "Challenge", {add_blind});
  add_group(app, "Shell", {ballbar::add_help_command, ballbar::add_completion_command, ballbar::add_man_command});
}

// The program's options and commands.
void set_up(CLI::App& app) {
  app.name("ballbar");
  app.require_subcommand(1);
  ballbar::set_help(app);
  app.set_version_flag("--version", "ballbar " BALLBAR_VERSION, "print the version");
  ballbar::add_page_option(app);
  app.footer(
      "ballbar FILE... without a command does what the file is for: the errors of a ballbar test, the drift of a "
      "session,\n"
      "the verdict on a series; with --page [FILE] as a page. ballbar help COMMAND lists the options of a command.");
  add_commands(app);
  ballbar::expect_values(app);
}

}  // namespace

namespace ballbar {

void run_command(const std::vector<std::string>& words) {
  CLI::App app{"Ballbar logs to thermal drift of the spindle."};
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
    print_help(help_of(*command));
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_fault(app, error, words));
  }
}

int program(const std::vector<std::string>& words) {
  try {
    run_command(words);
  } catch (const UsageError& error) {
    error_line(error.what());
    return 2;
  } catch (const std::exception& error) {  // Error; out of memory, a full disk
    error_line(error.what());
    return 1;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
    error_line(fmt::format("the results could not be written to the standard output: {}", std::strerror(errno)));
    return 1;
  }
  return 0;
}

}  // namespace ballbar
