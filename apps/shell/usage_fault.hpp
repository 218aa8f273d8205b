// One sentence for an error in a command line: what was expected and found, the nearest name, and the help to read.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace ballbar {

// `words`: of the command line, without the program's name.
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

bool is_option(const std::string& word);  // of a command line: --out, -h; "-" is a file

// "ballbar simulate score"
std::string full_name(const CLI::App& app);

// The names of its commands, hidden ones left out.
std::vector<std::string> command_names(const CLI::App& app);

// "; the nearest is fit", empty where none is near.
std::string nearest_hint(const std::string& found, const std::vector<std::string>& known);

}  // namespace ballbar
