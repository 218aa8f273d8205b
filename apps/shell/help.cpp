#include "shell/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include "ballbar/internal/nearest_name.hpp"
#include "shell/command_words.hpp"
#include "shell/usage_fault.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kHelpWidth = 112;

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
  explicit HelpFormatter(bool details) : details_(details) { label("SUBCOMMAND", "COMMAND ..."); }

  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return "";
    std::string text = option->get_type_name().empty() ? "" : " " + option->get_type_name();
    if (!option->get_default_str().empty()) text += "=" + option->get_default_str();
    if (option->get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
    return option->get_required() ? text + " REQUIRED" : text;
  }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) + options_text(*app) +
           make_subcommands(app, mode) + '\n' + make_footer(app);
  }

  // No empty lines between the headings, which are many.
  std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_subcommands(app, mode);
    for (std::size_t at = 0; (at = text.find("\n\n", at)) != std::string::npos;) text.erase(at, 1);
    return text;
  }

 private:
  static constexpr const char* kMainGroup = "Options";  // of CLI11

  std::string options_text(const CLI::App& app) const {
    std::string listed, named;
    for (const std::string& group : app.get_groups()) {
      const auto options =
          app.get_options([&](const CLI::Option* one) { return one->get_group() == group && one->nonpositional(); });
      if (group.empty() || options.empty()) continue;
      if (details_ || group == kMainGroup) {
        listed += make_group(group, false, options);
      } else {
        named += names_text(group, options);
      }
    }
    if (named.empty()) return listed;
    return fmt::format("{}\nMore options, listed by {} --help --details:\n{}", listed, full_name(app), named);
  }

  static std::string names_text(const std::string& group, const std::vector<const CLI::Option*>& options) {
    std::vector<std::string> names;
    names.reserve(options.size());
    for (const CLI::Option* option : options) names.push_back(option->get_name());
    std::istringstream lines(wrapped(fmt::format("{}: {}", group, fmt::join(names, ", ")), kHelpWidth));
    std::string text;
    for (std::string line; std::getline(lines, line);)
      text += fmt::format("{}{}\n", text.empty() ? "  " : "    ", line);
    return text;
  }

  bool details_;
};

struct HelpArguments {
  std::vector<std::string> words;
  bool details = false, completion = false;
};

}  // namespace

std::string help_of(const CLI::App& app, bool details) {
  return HelpFormatter(details).make_help(&app, full_name(app), CLI::AppFormatMode::Normal);
}

void set_help(CLI::App& app) { app.set_help_flag("-h,--help", "print this help"); }

void add_help_command(CLI::App& app) {
  const auto asked = std::make_shared<HelpArguments>();
  CLI::App* command = app.add_subcommand("help", "Show the help of a command");
  CLI::Option* words = command->add_option("COMMAND", asked->words, "command, such as drift")->type_name("");
  CLI::Option* details = command->add_flag("--details", asked->details, "list all options");
  add_choice(*command, "--completion", {"bash"}, "", "print a completion script for the shell",
             [asked](std::size_t) { asked->completion = true; });
  command->get_option("--completion")->excludes(words)->excludes(details);
  command->footer(
      "Example:\n"
      "  source <(ballbar help --completion bash)");
  command->callback([asked, &app] {
    if (asked->completion) {
      fmt::print("{}", bash_completion(command_words(app)));
    } else {
      const CLI::App* of = &app;
      for (const std::string& word : asked->words) of = &command_of(*of, word);
      print_help(help_of(*of, asked->details));
    }
  });
}

void print_help(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) fmt::print("{}\n", is_heading(line) ? bold(line) : line);
}

}  // namespace ballbar
