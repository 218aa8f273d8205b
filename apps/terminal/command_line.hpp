// The command line of a program that runs commands, and the data that its words stand for.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/text/source.hpp"

namespace ballbar {

// A word for data is a path, or the name of a value that the program holds.
class CommandLine : public CLI::App {
 public:
  using CLI::App::App;
  std::map<std::string, Source> values;        // by their names
  Catalogue catalogue = built_in_catalogue();  // of effects that models may have
};

// That of the command line that a command belongs to.
const Catalogue& catalogue_of(const CLI::App& command);

// An option or a place for data.
CLI::Option* add_source(CLI::App& command, const std::string& name, Source& source, const std::string& help);
CLI::Option* add_sources(CLI::App& command, const std::string& name, std::vector<Source>& sources,
                         const std::string& help);

}  // namespace ballbar
