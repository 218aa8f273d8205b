// The command line of the study.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ballbar::verdicts {

struct Options {
  std::uint64_t count = 24, first = 1;
  std::vector<std::string> cells;  // names, or how they begin with a * behind; none: all
  bool is_verbose = false, lists = false;
  std::string folder;  // to write one set to: cell and seed `first`
};

// Throws std::runtime_error for what it does not know.
Options options_of(const std::vector<std::string>& words);

bool is_wanted(const Options& options, const std::string& cell);

}  // namespace ballbar::verdicts
