// Which parameters of a user's formula are gains: found by trying.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

using Values = std::function<void(const EffectRows& rows, const double* parameters, double* values)>;

// Sets the kinds. A gain: on made-up rows, with the other parameters at random values near their starts, the value is a
// straight line through those at 0 and 1 also at 2, far out, below 0, at the start and the bounds; and its slope does
// not depend on the gains before it. Where a value is not finite it is no gain.
void find_kinds(std::vector<Parameter>& parameters, std::span<const Input> inputs, const Values& values);

}  // namespace ballbar
