// An effect outside the catalogue: the part of an error that depends on the temperature at the start of a run.
//
// For one run it is a constant; with several runs a regression needs it (effect_regression.hpp).
#pragma once

#include <memory>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

const std::shared_ptr<const Effect>& temperature_at_start();

}  // namespace ballbar
