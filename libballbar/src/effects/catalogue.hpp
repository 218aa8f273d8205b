// Every effect of the catalogue, one file each; effects.cpp lists them.
#pragma once

#include "ballbar/effect.hpp"

namespace ballbar::catalogue {

// On a drift series.
extern const Effect kExpansion;
extern const Effect kLaggedExpansion;
extern const Effect kSpeedHeating;
extern const Effect kCentrifugalShift;
extern const Effect kCoolingAsymmetry;
extern const Effect kViscosityFeedback;
extern const Effect kLoadHeating;
extern const Effect kGradientBending;
extern const Effect kBearingRings;
extern const Effect kBearingClearance;
extern const Effect kPreloadLoss;
extern const Effect kAxialCrosstalk;
extern const Effect kPlayHysteresis;
extern const Effect kThermostatCycle;
extern const Effect kDayCycle;
extern const Effect kSettling;
extern const Effect kLinearDrift;
extern const Effect kStep;
extern const Effect kBarTemperature;
extern const Effect kClockOffset;

// On a recording.

}  // namespace ballbar::catalogue
