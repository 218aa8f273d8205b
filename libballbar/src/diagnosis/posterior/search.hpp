// The search for sets of effects that make the readings likely: every effect alone, pairs, triples, beside the model
// about its fit and about where the best sets have its parameters.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

// wanted: a set of families that is weighed whatever its weight; empty: none.
// Shapes of strong effects between the points of the grid are added to the library. weighed: told of the table whenever
// more sets are in it; may be empty.
Posterior posterior_of(Problem& problem, std::size_t largest_set, std::vector<std::size_t> wanted = {},
                       const std::function<void(const SetTable&)>& weighed = {});

}  // namespace ballbar
