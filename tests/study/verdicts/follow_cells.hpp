// Runs of a given length, for what is said while they grow.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "made.hpp"

namespace ballbar::verdicts {

struct FollowCell {
  std::string name;
  bool is_nothing = false;  // nothing is hidden
  std::function<Made(std::uint64_t seed)> make;
};

std::vector<FollowCell> follow_cells(double hours);

}  // namespace ballbar::verdicts
