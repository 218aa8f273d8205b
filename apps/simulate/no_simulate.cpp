// In place of simulate.cpp in the page, which carries no laboratory.
#include <CLI/CLI.hpp>

#include "ballbar/error.hpp"
#include "commands.hpp"

namespace ballbar::commands {

void add_simulate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "Simulate recordings and signals of a virtual machine");
  command->allow_extras();
  command->callback([] { throw Error("simulate: not available in the page. Use the program on a computer."); });
}

}  // namespace ballbar::commands
