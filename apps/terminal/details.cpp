#include "terminal/details.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "terminal/terminal_table.hpp"

namespace ballbar {

void add_details(CLI::App& command, bool& details) {
  command.add_flag("--details", details, "print everything: whole tables, and what the figures mean");
}

std::string details_text(std::string_view what) { return wrapped(fmt::format("--details shows {}.", what)); }

}  // namespace ballbar
