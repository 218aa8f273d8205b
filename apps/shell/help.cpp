#include "shell/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/nearest_name.hpp"
#include "shell/command_words.hpp"
#include "shell/usage_fault.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

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

// Which options exclude each other is said where they meet; in a list it hides what each is for.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return "";
    std::string text = option->get_type_name().empty() ? "" : " " + option->get_type_name();
    if (!option->get_default_str().empty()) text += "=" + option->get_default_str();
    if (option->get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
    return option->get_required() ? text + " REQUIRED" : text;
  }

  // The options of logs are listed by `import`; the other commands name them.
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (group != kLogGroup) return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
    std::vector<std::string> names;
    names.reserve(options.size());
    for (const CLI::Option* option : options) names.push_back(option->get_name());
    return fmt::format("\n{}:\n{}", group, wrapped(fmt::format("{}", fmt::join(names, ", "))));
  }
};

using Completion = std::string (*)(const std::vector<CommandWords>& commands);
constexpr std::array<Completion, 3> kCompletions{bash_completion, zsh_completion, fish_completion};

// A command of the version before, and what does its work now.
struct OldCommand {
  std::string_view name, now, help;
};

constexpr OldCommand kOldCommands[] = {
    {"merge", "import LOG LOG...", "import"},
    {"fleet", "history FOLDER...", "history"},
    {"page", "report --tool", "report"},
    {"try", "add EFFECT... DATA --dry-run", "add"},
    {"preflight", "could DATA", "could"},
    {"inject", "could EFFECT DATA", "could"},
    {"terms", "effects --terms", "effects"},
    {"select", "train RUNS --for DATA", "train"},
    {"meanpoint", "compensate --from-picture FILE", "compensate"},
    {"blind", "simulate --hidden, simulate SET --schedule FILE, or simulate score DIR", "simulate"},
    {"completion", "help --completion SHELL", "help"},
    {"man", "help --man", "help"},
};

struct HelpArguments {
  std::vector<std::string> words;
  bool man = false;
  Completion completion = nullptr;
};

}  // namespace

std::string help_of(const CLI::App& app) {
  return app.get_formatter()->make_help(&app, full_name(app), CLI::AppFormatMode::Normal);
}

void set_help(CLI::App& app) {
  const auto formatter = std::make_shared<HelpFormatter>();
  formatter->label("SUBCOMMAND", "COMMAND ...");
  app.formatter(formatter);
  app.set_help_flag("-h,--help", "print this help");
}

void add_help_command(CLI::App& app) {
  const auto asked = std::make_shared<HelpArguments>();
  CLI::App* command = app.add_subcommand("help", "Show the help of a command");
  CLI::Option* words = command->add_option("COMMAND", asked->words, "command, such as drift")->type_name("");
  CLI::Option* man = command->add_flag("--man", asked->man, "print the manual page for man(1)");
  add_choice(*command, "--completion", {"bash", "zsh", "fish"}, "", "print a completion script for the shell",
             [asked](std::size_t at) { asked->completion = kCompletions.at(at); });
  man->excludes(words);
  command->get_option("--completion")->excludes(words)->excludes(man);
  command->footer(
      "Examples:\n"
      "  ballbar help --man | man -l -\n"
      "  source <(ballbar help --completion bash)");
  command->callback([asked, &app] {
    if (asked->man) {
      fmt::print("{}", man_page(app));
    } else if (asked->completion != nullptr) {
      fmt::print("{}", asked->completion(command_words(app)));
    } else if (const std::string now = asked->words.empty() ? "" : renamed_command(asked->words.front());
               !now.empty()) {
      fmt::print("{}\n", now);
    } else {
      const CLI::App* of = &app;
      for (const std::string& word : asked->words) of = &command_of(*of, word);
      print_help(help_of(*of));
    }
  });
}

std::string renamed_command(const std::string& name) {
  for (const OldCommand& old : kOldCommands) {
    if (old.name == name)
      return fmt::format("{} has been replaced by ballbar {}. See ballbar {} --help.", old.name, old.now, old.help);
  }
  return "";
}

void print_help(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) fmt::print("{}\n", is_heading(line) ? bold(line) : line);
}

}  // namespace ballbar
