// Data of a command, and the options that say how their logs are read.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "ballbar/formats/text/log_recipe.hpp"
#include "ballbar/formats/text/source.hpp"

namespace ballbar {

// An option or a place for data. The command gets the options of a log once; all its data carry the recipes
// that they make.
CLI::Option* add_data(CLI::App& command, const std::string& name, Source& source, const std::string& help);
CLI::Option* add_data(CLI::App& command, const std::string& name, std::vector<Source>& sources,
                      const std::string& help);

// Of a command whose first place was taken away: the next one is the first.
void forget_places(CLI::App& command);

}  // namespace ballbar
