// The folds of a record for cross-validation: each is left out in turn and predicted from the others.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// The fold of each given row, from 0. Folds are stretches between changes of speed. Short ones are merged with a
// neighbour, those of more than a fifth of the rows are cut into equal pieces. Without a speed the time is cut into
// five. In a trace each recording is a fold; a single recording has the quarters of its sweep.
std::vector<std::size_t> folds_of(const Series& data, const std::vector<std::size_t>& rows);

}  // namespace ballbar
