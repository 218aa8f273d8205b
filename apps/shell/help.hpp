// `ballbar help [COMMAND]`, the completion, and how help is printed.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace ballbar {

// The words of --help of all commands; before the commands are added, which take it over.
void set_help(CLI::App& app);

// Of this very command, whichever the command line chose. Options that have a group of their own are only named without
// `details`.
std::string help_of(const CLI::App& app, bool details);

void add_help_command(CLI::App& app);

// Prints it, headings in bold on a terminal.
void print_help(const std::string& text);

}  // namespace ballbar
