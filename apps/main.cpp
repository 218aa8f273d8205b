// `ballbar COMMAND`: exit 0 done, 1 the input is at fault, 2 the command line is at fault.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "ballbar/error.hpp"
#include "commands.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Ballbar logs to thermal drift of the spindle."};
  app.name("ballbar");
  app.require_subcommand(1);
  app.set_version_flag("--version", "ballbar " BALLBAR_VERSION);
  ballbar::commands::add_fit(app);
  ballbar::commands::add_drift(app);
  ballbar::commands::add_simulate(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const ballbar::Error& error) {
    fmt::print(stderr, "ballbar: {}\n", error.what());
    return 1;
  } catch (const std::exception& error) {  // out of memory, a full disk
    fmt::print(stderr, "ballbar: {}\n", error.what());
    return 1;
  }
  return 0;
}
