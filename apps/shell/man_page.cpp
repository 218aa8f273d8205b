#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <sstream>

#include "shell/command_words.hpp"

namespace ballbar {
namespace {

// Text as roff takes it: no backslash, dash, quote or dot at the start of a line means anything.
std::string roff(const std::string& text) {
  std::string page;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts = i == 0 || text[i - 1] == '\n';
    if (starts && (text[i] == '.' || text[i] == '\'')) page += "\\&";
    if (text[i] == '\\') {
      page += "\\e";
    } else if (text[i] == '-') {
      page += "\\-";
    } else if (text[i] == '\'') {
      page += "\\(aq";
    } else if (text[i] == '`') {
      page += "\\(ga";
    } else {
      page += text[i];
    }
  }
  return page;
}

std::string in_bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string in_italics(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string entry_of(const OptionWords& option, bool is_place) {
  std::string names;
  for (const std::string& name : option.names) {
    names += (names.empty() ? "" : ", ") + (is_place ? in_italics(name) : in_bold(name));
  }
  if (!option.value.empty()) names += " " + in_italics(option.value);
  if (is_place && option.is_many) names += " ...";
  const std::string required = !is_place && option.is_required ? " (required)" : "";
  return fmt::format(".TP\n{}\n{}{}\n", names, roff(option.help), required);
}

// Lines as they are, with their heading.
std::string examples_of(const CommandWords& command) {
  if (command.examples.empty()) return "";
  std::istringstream lines(command.examples);
  std::string heading, page;
  std::getline(lines, heading);
  for (std::string line; std::getline(lines, line);) page += roff(line) + "\n";
  return fmt::format(".PP\n{}\n.PP\n.nf\n{}.fi\n", roff(heading), page);
}

std::string section_of(const CommandWords& command) {
  std::string synopsis = in_bold("ballbar " + command.path);
  for (const OptionWords& place : command.places) {
    const std::string name = in_italics(place.names.front()) + (place.is_many ? "..." : "");
    synopsis += place.is_required ? " " + name : " [" + name + "]";
  }
  std::string page =
      fmt::format(".SS {}\n{}\n.PP\n{}.\n", roff("ballbar " + command.path), synopsis, roff(command.summary));
  for (const OptionWords& place : command.places) page += entry_of(place, true);
  for (const OptionWords& option : command.options) page += entry_of(option, false);
  return page + examples_of(command);
}

}  // namespace

std::string man_page(const CLI::App& app) {
  const std::vector<CommandWords> commands = command_words(app);
  std::string page = fmt::format(
      ".TH BALLBAR 1 \"\" \"{}\"\n.SH NAME\nballbar \\- {}\n.SH SYNOPSIS\n.B ballbar\n.I COMMAND\n[...]\n.br\n.B "
      "ballbar\n.IR FILE ...\n[\\fB\\-\\-page\\fR [\\fIFILE\\fR]]\n.SH DESCRIPTION\n{}\n.SH OPTIONS\n",
      roff(app.version()), roff(commands.front().summary), roff(commands.front().examples));
  for (const OptionWords& option : commands.front().options) page += entry_of(option, false);
  page += ".SH COMMANDS\n";
  for (const CommandWords& command : commands) {
    if (!command.path.empty()) page += section_of(command);
  }
  return page +
         ".SH EXIT STATUS\n.TP\n0\nSuccess, whatever the verdict.\n.TP\n1\nAn input has a fault, or a result cannot be "
         "written.\n.TP\n2\nThe command line has a fault.\n"
         ".SH ENVIRONMENT\n.TP\n.B NO_COLOR\nIf not empty, the output has no colour.\n.TP\n.B TERM\nIf dumb or not "
         "set, the output has no colour.\n";
}

}  // namespace ballbar
