// What a search that still runs can say.
#pragma once

#include "ballbar/model/bound_effect.hpp"

namespace ballbar {

// How probable it is that an effect is missing, by the sets that have been weighed so far.
struct ProbableSoFar {
  BoundEffect bound;
  double p = 0.0;
};

}  // namespace ballbar
