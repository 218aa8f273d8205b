// Pairs of effects weighed beside one variant of the model.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/table.hpp"

namespace ballbar {

// Of the families that are strongest alone, on a thin grid at the best points; then the best pairs on fine grids where
// the best of them is likely: these points, none where no pair has been found.
std::vector<std::size_t> weigh_pairs(const Problem& problem, SetTable& table, std::size_t variant);

// One pair on all its shapes, at the best points.
void weigh_pair(const Problem& problem, SetTable& table, std::size_t variant, const SetKey& pair);

}  // namespace ballbar
