// Writes the parts of the package that say what the program says: a function of Python for each command, and a class
// for each effect of the catalogue.
//
//   python_api functions FILE
//   python_api effects FILE
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <exception>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "program.hpp"
#include "shell/command_words.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kWidth = 112;

struct Function {
  std::string_view name, command, result;
  std::string_view fixed = {};        // options that it always gives, as Python
  std::string_view without = {};      // an option that would need others than these
  std::string_view answers = "True";  // when the command answers, as Python: not where it writes a file instead
};

// `errors`, `check`, `diagnose`, `add` and their like are tables and values of Python: Model, Fit.
constexpr Function kFunctions[] = {
    {"circles", "fit", "Fitted"},
    {"machine_errors", "errors", "RankedErrors", R"("show": "ranked")", "out"},
    {"drift", "drift", "Drift"},
    {"compare", "compare", "Comparison"},
    {"history", "history", "History"},
    {"import_log", "import", "Imported"},
    {"effects", "effects", "Effects"},
    {"could", "could", "Preflight"},
    {"plan", "plan", "Plan"},
    {"train", "train", "Trained"},
    {"predict", "predict", "Predicted"},
    {"compensate", "compensate", "Replay", "", "", "on is not None or from_picture is not None"},
    {"report", "report", "Report", "", "", "out is None"},
    {"simulate", "simulate", "Simulated"},
};

// Of the terminal, of a process of its own, or said by `fixed`.
const std::set<std::string, std::less<>> kNotOfPython{"help", "json",   "show",   "table",  "workers", "scheduler",
                                                      "open", "live",   "follow", "serve",  "all",     "width",
                                                      "page", "format", "tool",   "signals"};

// The unit of a number, at the end of its name.
const std::map<std::string, std::string, std::less<>> kNumbers{
    {"TIME", "_s"}, {"UM", "_um"}, {"MM", "_mm"}, {"LENGTH", "_mm"}, {"MIN", "_min"}, {"RPM", ""}, {"H", ""},
    {"N", ""},      {"K2", ""},    {"SHARE", ""}, {"RATE", ""},      {"PX", ""},      {"K", ""},   {"UM/S", ""},
    {"K/S", ""},    {"S", ""},     {"DEGC", ""},  {"PPM/K", ""},     {"FLOAT", ""}};

std::string python_name(std::string name) {
  name.erase(0, name.find_first_not_of('-'));
  std::replace(name.begin(), name.end(), '-', '_');
  static const std::set<std::string, std::less<>> kWords{"for", "from", "with", "in", "is"};
  return kWords.contains(name) ? name + "_" : name;
}

// Options that Model.fit takes too, under its names for them.
const std::map<std::string, std::string, std::less<>> kAsOfFit{
    {"unit", "units"}, {"role", "roles"}, {"every", "every"}};

struct Argument {
  std::string name, type, otherwise, meaning, value;  // value: as it is handed on
  std::string option;                                 // "max_gap"; empty of a place
};

std::string upper(std::string text) {
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

// `max_gap` for --max-gap.
std::string with_arguments(const std::string& text) {
  static const std::regex kOption("--[a-zA-Z][a-zA-Z0-9-]*");
  std::string result;
  auto from = text.cbegin();
  for (auto at = std::sregex_iterator(text.begin(), text.end(), kOption); at != std::sregex_iterator(); ++at) {
    result.append(from, text.cbegin() + at->position());
    result += "`" + python_name(at->str()) + "`";
    from = text.cbegin() + at->position() + at->length();
  }
  return result.append(from, text.cend());
}

std::string sentence(std::string text) {
  constexpr std::string_view kRepeated = "; may be repeated";  // a list says so
  if (text.ends_with(kRepeated)) text.erase(text.size() - kRepeated.size());
  text = with_arguments(text);
  if (text.substr(0, text.find(' ')).find('.') == std::string::npos) text = upper(text);  // no name of a file
  return text.empty() || text.back() == '.' ? text : text + ".";
}

Argument place_of(const OptionWords& words) {
  Argument argument;
  const bool is_with_effect = words.names.front() == "EFFECT_AND_DATA";  // which is an argument of its own
  std::string name = is_with_effect ? "data" : words.names.front();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  argument.name = python_name(name);
  argument.type = "Data";
  argument.meaning = is_with_effect ? "Series, session, or recordings." : sentence(words.help);
  argument.value = argument.name;
  if (!words.is_required) {
    argument.type += " | None";
    argument.otherwise = "None";
  }
  return argument;
}

Argument option_of(const OptionWords& words, const Function& of) {
  Argument argument;
  const std::string& name = words.names.back();
  argument.option = python_name(name);
  argument.name = argument.option;
  if (of.command == "train" && argument.option == "model") argument.type = "Path | None";  // a file alone
  argument.meaning = sentence(words.help);
  if (!words.words.empty()) argument.meaning += fmt::format(" One of {}.", fmt::join(words.words, ", "));
  argument.otherwise = words.is_required ? "" : "None";
  if (words.takes == Takes::nothing) {
    argument.type = "bool";
    argument.otherwise = "False";
  } else if (const auto number = kNumbers.find(words.value); number != kNumbers.end()) {
    argument.type = words.value == "N" ? "int" : "float";
    if (!argument.name.ends_with(number->second)) argument.name += number->second;
    if (argument.option == "every") argument.type = "Every";
  } else if (words.value == "DATA") {
    argument.type = "Data";
  } else if (words.takes == Takes::file || words.takes == Takes::folder) {
    argument.type = argument.option == "model" ? "ModelLike" : "Path";
  } else {
    argument.type = words.value.find('=') != std::string::npos ? "Mapping[str, Any]" : "str";
  }
  if (const auto known = kAsOfFit.find(argument.option); known != kAsOfFit.end()) argument.name = known->second;
  if (words.is_many && !argument.type.starts_with("Mapping") && argument.type != "Data")
    argument.type += " | Sequence[" + argument.type + "]";
  if (argument.otherwise == "None" && argument.type != "Every") argument.type += " | None";
  argument.value = words.value == "DATA" ? fmt::format("DataOf({})", argument.name) : argument.name;
  return argument;
}

std::string indented(const std::string& text, std::size_t indent) {
  std::istringstream all(wrapped(text, kWidth - indent));
  std::string lines;
  for (std::string line; std::getline(all, line);) lines += std::string(indent, ' ') + line + "\n";
  return lines;
}

std::string function_text(const Function& of, const CommandWords& command) {
  std::vector<Argument> arguments;
  std::string parameters, names, options(of.fixed);
  std::vector<std::string> places;
  if (of.command == "could") places.emplace_back("effect");
  for (const OptionWords& words : command.places) {
    arguments.push_back(place_of(words));
    places.push_back(arguments.back().value);
  }
  std::size_t keyword = arguments.size();
  if (of.command == "could")
    arguments.push_back(
        {"effect", "str | None", "None", "One effect to add, such as ``expansion(T_room_degC)``.", "effect", ""});
  std::vector<Argument> by_keyword;
  for (const OptionWords& words : command.options) {
    const std::string name = python_name(words.names.back());
    if (kNotOfPython.contains(name) || name == of.without) continue;
    by_keyword.push_back(option_of(words, of));
  }
  const auto needed = [](const Argument& one) { return one.otherwise.empty(); };
  std::stable_partition(by_keyword.begin(), by_keyword.end(), needed);
  for (const Argument& one : by_keyword) {
    options +=
        fmt::format("{}\"{}\": {}", options.empty() ? "" : ", ",
                    one.option.ends_with('_') ? one.option.substr(0, one.option.size() - 1) : one.option, one.value);
    arguments.push_back(one);
  }
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const Argument& one = arguments[k];
    const std::string line =
        fmt::format("{}: {}{}", one.name, one.type, one.otherwise.empty() ? "" : " = " + one.otherwise);
    names += fmt::format("{}    {},\n", k == keyword ? "    *,\n" : "", line);
    parameters += fmt::format("    {} : {}\n{}", one.name, one.type, indented(one.meaning, 8));
  }
  return fmt::format(
      "\n\ndef {}(\n{}    progress: Progress | None = None,\n) -> {}:\n    \"\"\"{}.\n\n"
      "    The command ``ballbar {}`` of the program.\n\n    Parameters\n    ----------\n{}"
      "    progress : callable\n        Called with (done, of, text); `of` is 0 if the length of the work is "
      "unknown.\n\n"
      "    Returns\n    -------\n    {}\n        As ``ballbar {} --json``, to the last bit.\n\n"
      "    Raises\n    ------\n    BallbarError\n        Data or a value that can be put right: the sentence says "
      "how.\n    \"\"\"\n"
      "    options: dict[str, Any] = {{{}}}\n    return {}(run(\"{}\", [{}], options, progress, answers={}))\n",
      of.name, names, of.result, command.summary, of.command, parameters, of.result, of.command, options, of.result,
      of.command, fmt::join(places, ", "), of.answers);
}

std::string functions_file() {
  std::string text =
      "\"\"\"The commands of the program as functions, made of its options by python_api.\"\"\"\n"
      "from __future__ import annotations\n\nfrom collections.abc import Mapping, Sequence\nfrom typing import Any\n\n"
      "from ._call import Data, DataOf, Every, ModelLike, Path, Progress, run\nfrom ._kinds import (\n    ";
  std::set<std::string_view> results;
  for (const Function& one : kFunctions) results.insert(one.result);
  text += fmt::format("{},\n)\n", fmt::join(results, ",\n    "));
  const std::vector<CommandWords> commands = words_of_commands();
  for (const Function& one : kFunctions) {
    const auto command = std::find_if(commands.begin(), commands.end(),
                                      [&](const CommandWords& words) { return words.path == one.command; });
    if (command == commands.end()) throw Error(fmt::format("{}: expected a command, found none.", one.command));
    text += function_text(one, *command);
  }
  return text;
}

std::string class_name(const Effect& effect) {
  std::string name;
  bool begins = true;
  for (const char c : effect.name) {
    if (c != '_') name += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '_';
  }
  const bool twice = find_effect(effect.name, Level::series) != nullptr && effect.level == Level::recording;
  return twice ? name + "OfRecordings" : name;
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:g}", value) : value > 0 ? "inf" : "-inf";
}

std::string class_text(const Effect& effect) {
  const bool of_recordings = effect.level == Level::recording;
  std::string parameters, names, columns, values;
  if (!of_recordings) {
    for (const Input& input : effect.inputs) {
      names += fmt::format(", {}: str", python_name(input.role));
      columns += fmt::format("{}\"{}\": {}", columns.empty() ? "" : ", ", input.role, python_name(input.role));
      parameters += fmt::format(
          "    {} : str\n{}", python_name(input.role),
          indented(sentence(fmt::format("Column: {}{}", input.meaning,
                                        input.units.empty() ? "" : fmt::format("; {}", fmt::join(input.units, ", ")))),
                   8));
    }
  }
  if (!effect.parameters.empty()) names += ", *";
  for (const Parameter& one : effect.parameters) {
    names += fmt::format(", {}: float | Free | None = None", one.name);
    values += fmt::format("{}\"{}\": {}", values.empty() ? "" : ", ", one.name, one.name);
    parameters += fmt::format(
        "    {} : float or Free\n{}", one.name,
        indented(sentence(fmt::format(
                     "{}, {}; {}", one.meaning, one.unit == "1" ? "no unit" : one.unit,
                     one.held ? fmt::format("held at {} unless given", number_text(one.start))
                              : fmt::format("free from {} to {}", number_text(one.lower), number_text(one.upper)))),
                 8));
  }
  const bool has_zero = !of_recordings && !effect.inputs.empty();
  const std::string zero =
      has_zero ? indented(
                     "Its zero is the first row of the run, where it is at rest. :meth:`Fit.predict` continues the run "
                     "of the fit for its rows and those that follow; any other data are a run with its own zero.",
                     4) +
                     "\n"
               : "";
  return fmt::format(
      "\n\nclass {}(Effect):\n    r\"\"\"{}\n\n{}\n    ``{}``\n\n{}    Parameters\n    ----------\n{}    \"\"\"\n\n"
      "    of_recordings = {}\n    effect_name = \"{}\"\n\n    def __init__(self{}) -> None:\n        "
      "super().__init__(\"{}\", {{{}}}, {{{}}})\n",
      class_name(effect), sentence(effect.explanation.summary), indented(effect.explanation.cause, 4),
      effect.explanation.formula, zero, parameters, of_recordings ? "True" : "False", effect.name, names, effect.name,
      columns, values);
}

std::string effects_file() {
  std::string text =
                  "\"\"\"The effects of the catalogue as classes, made of it by python_api.\"\"\"\n"
                  "from __future__ import annotations\n\nfrom ._terms import Effect, Free\n",
              names, classes;
  for (const auto& effect : built_in_catalogue()) {
    if (effect->rules.is_base || effect->rules.of_set_up) continue;
    classes += class_text(*effect);
    names += fmt::format("    \"{}\",\n", class_name(*effect));
  }
  return text + "\n__all__ = [\n" + names + "]\n" + classes;
}

int run(const std::vector<std::string_view>& words) {
  if (words.size() != 2 || (words[0] != "functions" && words[0] != "effects"))
    throw Error("usage: python_api functions|effects FILE");
  write_bytes(std::filesystem::path(words[1]), words[0] == "effects" ? effects_file() : functions_file());
  return 0;
}

}  // namespace
}  // namespace ballbar

int main(int argc, char** argv) {
  try {
    return ballbar::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
