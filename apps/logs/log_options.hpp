// Options that say how a log is read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/logs/log.hpp"

namespace CLI {
class App;
}

namespace ballbar {

struct LogOptions {
  std::string recipe;  // file
  std::string sheet, delimiter, decimal, dates, time, time_unit;
  std::optional<double> every_s;
  std::vector<std::string> missing, units, roles, names, left_out;
};

void add_log_options(CLI::App& command, LogOptions& options);

// The recipe of the file, and what the command line says in its place. Throws Error.
LogRecipe recipe_of(const LogOptions& options);

}  // namespace ballbar
