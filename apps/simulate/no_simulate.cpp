// In place of simulate.cpp in the page, which carries no laboratory.
#include <CLI/CLI.hpp>

#include "ballbar/error.hpp"
#include "commands.hpp"

namespace ballbar::commands {

void add_simulate(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("simulate", "Recordings, signals and five-probe readings of a virtual machine");
  command->allow_extras();
  command->callback(
      [] { throw Error("simulate: expected the program on a computer, found the page, which is built without it."); });
}

}  // namespace ballbar::commands
