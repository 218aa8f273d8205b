// Sets of effects from a sum of single effects: one identity of each, or none.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/posterior/ibss.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

// The signature of a shape; that of a jump is added to the library. nullopt: it has none.
std::optional<std::size_t> signature_of(Problem& problem, const Identities& identities, std::size_t shape);

// A mode whose single effects and linearisation the posterior has at the same place.
struct ModeOfSets {
  std::size_t filter = 0;  // of its likeliest sum, in Posterior::filters
  const Identities& identities;
  const SumOfEffects& likeliest;
};

// Sets Posterior::sets and best: the most probable sets, with their most likely shapes at the most likely covariance of
// their mode.
void add_sets(Problem& problem, const std::vector<ModeOfSets>& modes, Posterior& posterior);

}  // namespace ballbar
