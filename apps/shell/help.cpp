#include "shell/help.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>
#include <vector>

#include "ballbar/nearest_name.hpp"
#include "shell/usage_fault.hpp"
#include "terminal/colour.hpp"

namespace ballbar {
namespace {

bool is_heading(const std::string& line) {
  return line.size() > 1 && line.front() >= 'A' && line.front() <= 'Z' && line.back() == ':';
}

const CLI::App& command_of(const CLI::App& app, const std::string& word) {
  const auto found = app.get_subcommands([&](const CLI::App* one) { return one->get_name() == word; });
  if (!found.empty()) return *found.front();
  throw CLI::ValidationError(fmt::format("expected a command of {}, found {}{}", full_name(app), in_quotes(word),
                                         nearest_hint(word, command_names(app))));
}

}  // namespace

std::string help_of(const CLI::App& app) {
  return app.get_formatter()->make_help(&app, full_name(app), CLI::AppFormatMode::Normal);
}

void set_help(CLI::App& app) {
  const auto formatter = std::make_shared<CLI::Formatter>();
  formatter->label("SUBCOMMAND", "COMMAND ...");
  app.formatter(formatter);
  app.set_help_flag("-h,--help", "print this help");
}

void add_help_command(CLI::App& app) {
  const auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("help", "The help of a command, or this list");
  command->add_option("COMMAND", *words, "as in ballbar help drift")->type_name("");
  command->callback([words, &app] {
    const CLI::App* of = &app;
    for (const std::string& word : *words) of = &command_of(*of, word);
    print_help(help_of(*of));
  });
}

void print_help(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) fmt::print("{}\n", is_heading(line) ? bold(line) : line);
}

}  // namespace ballbar
