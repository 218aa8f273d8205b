// An effect bound to the columns it reads.
#pragma once

#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

struct BoundEffect {
  const Effect* effect = nullptr;
  std::vector<std::string> columns;  // as effect->inputs
  bool operator==(const BoundEffect&) const = default;
};
std::string label_of(const BoundEffect& bound);  // "lagged_expansion(T_air_degC)"

}  // namespace ballbar
