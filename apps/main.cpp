// `ballbar COMMAND`: exit 0 done, 1 the input is at fault, 2 the command line is at fault.
#include <fmt/core.h>
#include <glog/logging.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>

#include "ballbar/error.hpp"
#include "commands.hpp"
#include "terminal/stderr_line.hpp"

namespace {

// What is wrong with the command line, and where help is.
std::string told(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const auto chosen = app.get_subcommands();
  if (!chosen.empty()) {
    std::string name = "ballbar";
    for (auto command = chosen; !command.empty(); command = command.front()->get_subcommands()) {
      name += " " + command.front()->get_name();
    }
    return fmt::format("{}; see {} --help", error.what(), name);
  }
  std::string names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  const std::string found = argc > 1 ? fmt::format("found '{}'", argv[1]) : "found none";
  return fmt::format("expected a command, {}; the commands are {}; see ballbar --help", found, names);
}

}  // namespace

int main(int argc, char** argv) {
  // Matrices of some 100 kB come and go: the memory stays with the process instead of being asked for anew each time.
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  FLAGS_minloglevel = google::GLOG_FATAL;  // of the solver: what it says stands in the results
  CLI::App app{"Ballbar logs to thermal drift of the spindle."};
  app.name("ballbar");
  app.require_subcommand(1);
  app.set_version_flag("--version", "ballbar " BALLBAR_VERSION);
  ballbar::commands::add_fit(app);
  ballbar::commands::add_drift(app);
  ballbar::commands::add_compare(app);
  ballbar::commands::add_history(app);
  ballbar::commands::add_simulate(app);
  ballbar::commands::add_effects(app);
  ballbar::commands::add_terms(app);
  ballbar::commands::add_preflight(app);
  ballbar::commands::add_check(app);
  ballbar::commands::add_diagnose(app);
  ballbar::commands::add_predict(app);
  ballbar::commands::add_try(app);
  ballbar::commands::add_add(app);
  ballbar::commands::add_undo(app);
  ballbar::commands::add_ledger(app);
  ballbar::commands::add_blind(app);
  ballbar::commands::add_inject(app);
  ballbar::commands::add_train(app);
  ballbar::commands::add_select(app);
  ballbar::commands::add_meanpoint(app);
  ballbar::commands::add_report(app);
  ballbar::commands::add_compensate(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    app.exit(help);
    std::cout.flush();
  } catch (const CLI::ParseError& error) {
    ballbar::stderr_line(fmt::format("ballbar: {}", told(app, error, argc, argv)));
    return 2;
  } catch (const ballbar::Error& error) {
    ballbar::stderr_line(fmt::format("ballbar: {}", error.what()));
    return 1;
  } catch (const std::exception& error) {  // out of memory, a full disk
    ballbar::stderr_line(fmt::format("ballbar: {}", error.what()));
    return 1;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
    ballbar::stderr_line(
        fmt::format("ballbar: the results could not be written to the standard output: {}", std::strerror(errno)));
    return 1;
  }
  return 0;
}
