// An effect that no catalogue has: what of an error goes with how warm the machine is as a run begins.
//
// Of one run it is a constant; of several a regression needs it (effect_regression.hpp).
#pragma once

#include <memory>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

const std::shared_ptr<const Effect>& temperature_at_start();

}  // namespace ballbar
