// A made set as files, to be looked at from the command line.
#pragma once

#include <string>

#include "made.hpp"

namespace ballbar::verdicts {

// data.csv, model.toml and truth.json; the folder is made where it is missing.
void write(const Made& made, const std::string& folder);

}  // namespace ballbar::verdicts
