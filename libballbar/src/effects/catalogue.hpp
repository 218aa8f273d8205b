// Every effect of the catalogue, one file each; effects.cpp lists them.
#pragma once

#include "ballbar/effect.hpp"

namespace ballbar::catalogue {

// On a drift series.
extern const Effect kExpansion;
extern const Effect kLaggedExpansion;
extern const Effect kSpeedHeating;

// On a recording.

}  // namespace ballbar::catalogue
