// The cells of the table.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "judged.hpp"
#include "twins.hpp"

namespace ballbar::verdicts {

struct Cell {
  std::string name;  // "one-10-held"; its random stream
  std::string aim;   // as printed
  std::function<Made(std::uint64_t seed)> make;
  std::optional<Change> change = std::nullopt;  // right: the twin's verdict is the same
};

// The set's twin; the same for the same cell and seed.
Twin twin_of(const Made& made, const Cell& cell);

std::vector<Cell> cells();

}  // namespace ballbar::verdicts
