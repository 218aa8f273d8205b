#include "terminal/option_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"

namespace ballbar {
namespace {

bool is_number(const std::string& text, double& value) {
  return CLI::detail::lexical_cast(text, value) && !std::isnan(value);
}

CLI::Validator validator(std::function<std::string(std::string&)> complaint) {
  return {std::move(complaint), ""};  // no words of its own in the help
}

CLI::AsNumberWithUnit seconds() {
  return CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}},
                               CLI::AsNumberWithUnit::CASE_SENSITIVE);
}

}  // namespace

std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

CLI::Validator number_within(double low, double high) {
  return validator([low, high](const std::string& found) {
    double value = 0.0;
    if (is_number(found, value) && value >= low && value <= high) return std::string();
    return fmt::format("expected a number from {} to {}, found {}", low, high, in_quotes(found));
  });
}

CLI::Validator whole_number_within(double low, double high) {
  return validator([low, high](const std::string& found) {
    double value = 0.0;
    const bool is_whole = !found.empty() && found.find_first_not_of("0123456789") == std::string::npos;
    if (is_whole && is_number(found, value) && value >= low && value <= high) return std::string();
    return fmt::format("expected a whole number from {} to {}, found {}", low, high, in_quotes(found));
  });
}

CLI::Validator number_above_0(bool or_infinite) {
  return validator([or_infinite](const std::string& found) {
    double value = 0.0;
    if (is_number(found, value) && value > 0.0 && (or_infinite || std::isfinite(value))) return std::string();
    return fmt::format("expected a number above 0{}, found {}", or_infinite ? " or inf" : "", in_quotes(found));
  });
}

CLI::Validator name_and_number() {
  return validator([](const std::string& found) {
    const std::size_t equals = found.find('=');
    double value = 0.0;
    if (equals != std::string::npos && equals > 0 && is_number(found.substr(equals + 1), value) &&
        std::isfinite(value)) {
      return std::string();
    }
    return fmt::format("expected NAME=NUMBER, found {}", in_quotes(found));
  });
}

CLI::Validator name_that_ends_in(std::vector<std::string> endings) {
  return validator([endings = std::move(endings)](const std::string& found) {
    const std::string ending = std::filesystem::path(found).extension().string();
    if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return std::string();
    const std::size_t last = endings.size() - 1;
    const std::string all =
        last == 0 ? endings.front()
                  : fmt::format("{} or {}", fmt::join(endings.begin(), endings.end() - 1, ", "), endings[last]);
    return fmt::format("expected a name that ends in {}, found {}", all, ending.empty() ? "no ending" : ending);
  });
}

std::optional<double> time_s_of(std::string text) {
  try {
    if (!seconds()(text).empty()) return std::nullopt;
  } catch (const CLI::ValidationError&) {
    return std::nullopt;
  }
  return finite_number(text);
}

void take_time(CLI::Option& option, bool above_0) {
  option.type_name("TIME")->transform(seconds().description(""));
  option.check(validator([above_0](const std::string& found) {
    double time_s = 0.0;  // stays 0 where it is too small for a double
    const bool finite = is_number(found, time_s) && std::isfinite(time_s);
    if (finite && (!above_0 || time_s > 0.0)) return std::string();
    return fmt::format("expected a finite time{}", above_0 ? " above 0" : "");
  }));
}

void add_radius(CLI::App& command, StatedCircle& circle) {
  CLI::AsNumberWithUnit mm(std::map<std::string, double>{{"mm", 1.0}, {"m", 1e3}, {"in", 25.4}},
                           CLI::AsNumberWithUnit::CASE_SENSITIVE);
  command
      .add_option("--radius", circle.radius_mm,
                  "nominal radius of circles, if the file does not state it: 100, 100mm or 0.1m")
      ->type_name("LENGTH")
      ->transform(mm.description(""))
      ->check(validator([](const std::string& found) {
        double radius_mm = 0.0;
        if (is_number(found, radius_mm) && std::isfinite(radius_mm) && radius_mm > 0.0) return std::string();
        return fmt::format("expected a finite length above 0, found {}", in_quotes(found));
      }));
}

void add_choice(CLI::App& command, const std::string& name, std::vector<std::string> words,
                const std::string& otherwise, const std::string& help, const std::function<void(std::size_t)>& at) {
  const std::string all = fmt::format("{}", fmt::join(words, "|"));
  command
      .add_option_function<std::string>(
          name,
          [name, words, at](const std::string& found) {
            const auto place = std::find(words.begin(), words.end(), found);
            if (place == words.end()) {
              throw CLI::ValidationError(
                  name, fmt::format("expected one of {}, found {}", fmt::join(words, ", "), in_quotes(found)));
            }
            at(static_cast<std::size_t>(place - words.begin()));
          },
          help)
      ->type_name(all)
      ->default_str(otherwise);
}

void expect_none_given(const std::vector<CLI::Option*>& options, std::string_view needed) {
  for (const CLI::Option* option : options) {
    if (option->count() > 0) throw CLI::ValidationError(fmt::format("{}: expected {}", option->get_name(), needed));
  }
}

std::string exclusion_text(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options([](const CLI::Option* one) { return one->count() > 0; })) {
    for (const CLI::Option* other : option->get_excludes()) {
      if (other->count() > 0)
        return fmt::format("{}: cannot be combined with {}", option->get_name(), other->get_name());
    }
  }
  return "";
}

void expect_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    if (option->get_expected_max() == 0 || option->get_type_size() == 0) continue;  // a flag
    option->check(validator([](const std::string& found) {
      return std::string(found.empty() ? "expected a value, found an empty one" : "");
    }));
  }
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) expect_values(*command);
}

void expect_no_input(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs,
                     std::string_view option) {
  for (const std::string& output : outputs) {
    for (const std::filesystem::path& input : inputs) {
      std::error_code absent;  // then it is not the same file
      if (!std::filesystem::equivalent(output, input, absent)) continue;
      throw Error(fmt::format("{} {}: expected another file than the inputs, found the input {}.", option, output,
                              input.string()));
    }
  }
}

}  // namespace ballbar
