// The stretches of a record by which a model is tested: each is left out in turn and predicted from the others.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Fold of every row, from 0: stretches between changes of speed, short ones merged with their neighbour, those of more
// than a fifth of the rows cut into equal pieces; without a speed five parts of the time. Of a trace each recording is
// one; a single recording is left out by quarters of its sweep.
std::vector<std::size_t> folds_of(const Series& data, const std::vector<std::size_t>& rows);

}  // namespace ballbar
