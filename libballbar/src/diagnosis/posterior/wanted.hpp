// A set that is asked for, weighed whatever its weight.
#pragma once

#include <cstddef>

#include "diagnosis/posterior/table.hpp"

namespace ballbar {

// A pair on all its shapes; of a larger set the shapes of one member after the other, beside the others at their best.
// Sets of none or one are always weighed: nothing to do.
void weigh_wanted(const Problem& problem, SetTable& table, std::size_t variant, const SetKey& wanted);

}  // namespace ballbar
