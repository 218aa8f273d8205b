// The cells of the table.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "judged.hpp"

namespace ballbar::verdicts {

struct Cell {
  std::string name;  // "one-10-held"; its random stream
  std::string aim;   // as printed
  std::function<Made(std::uint64_t seed)> make;
};

std::vector<Cell> cells();

}  // namespace ballbar::verdicts
