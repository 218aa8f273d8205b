// Sets of effects out of a sum of single effects: one identity, or none, of each.
#pragma once

#include <cstddef>
#include <optional>

#include "diagnosis/posterior/ascent.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

// The signature of a shape; of a jump it is put into the library. Nothing: it has none.
std::optional<std::size_t> signature_of(Problem& problem, const Identities& identities, std::size_t shape);

// The most probable sets, their shapes as they are likeliest at the likeliest covariance; Posterior::sets and best.
void add_sets(Problem& problem, const Identities& identities, const Ascent& likeliest, Posterior& posterior);

}  // namespace ballbar
