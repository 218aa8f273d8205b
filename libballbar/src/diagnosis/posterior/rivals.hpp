// A member of a set against inputs of any form in its place.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct Rival {
  std::string column;
  double log_evidence = 0.0;  // with this input, its form free, in the member's place
};

struct Rivals {
  double member = 0.0;        // ln of the evidence with the member, its shapes integrated
  std::vector<Rival> inputs;  // the strongest first
};

// The other members as they are most likely; over all covariances, with the prior of each.
Rivals rivals_of(const Problem& problem, const Posterior& posterior, const EffectSet& set, std::size_t member);

}  // namespace ballbar
