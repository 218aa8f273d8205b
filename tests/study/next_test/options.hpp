// The command line of the study.
#pragma once

#include <string>
#include <vector>

#include "next_test/loop.hpp"

namespace ballbar::next_test {

struct Options {
  std::uint64_t count = 24, first = 1;
  std::vector<std::string> cells;  // names, or how they begin with a * behind; none: all
  LoopOptions loop;
  std::size_t threads = 2;
  bool is_verbose = false, lists = false;
};

// Throws std::runtime_error for what it does not know.
Options options_of(const std::vector<std::string>& words);

}  // namespace ballbar::next_test
