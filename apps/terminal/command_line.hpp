// The command line of a program with commands, and the data that its words refer to.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/text/log_recipe.hpp"
#include "ballbar/formats/text/source.hpp"

namespace ballbar {

// How the logs of a command are read: of the first file of DATA as stated; of others, which may lack a column, and
// stand beside no other file.
struct LogRecipes {
  std::shared_ptr<LogRecipe> first, others;
  bool has_place = false;  // for data
};

// A word for data is a path, or the name of a value in memory.
class CommandLine : public CLI::App {
 public:
  using CLI::App::App;
  std::map<std::string, Source> values;                            // by their names
  Catalogue catalogue = built_in_catalogue();                      // of effects that models may have
  std::map<const CLI::App*, std::shared_ptr<LogRecipes>> recipes;  // by commands
  int status = 0;                                                  // exit status of a command that ran
};

// That of a command; nullptr: of another program.
CommandLine* line_of(CLI::App& command);
const CommandLine* line_of(const CLI::App& command);

// The data that a word of the command refers to.
Source source_of(const CLI::App& command, const std::string& word);

// That of the command line that a command belongs to.
const Catalogue& catalogue_of(const CLI::App& command);

// An option or a place for what is no log (log_options.hpp): a model, recordings.
CLI::Option* add_source(CLI::App& command, const std::string& name, Source& source, const std::string& help);
CLI::Option* add_sources(CLI::App& command, const std::string& name, std::vector<Source>& sources,
                         const std::string& help);

}  // namespace ballbar
