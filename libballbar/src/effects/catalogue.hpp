// Every effect of the catalogue, one file each; effects.cpp lists them.
#pragma once

#include "ballbar/effects/effect.hpp"

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
extern const Effect kCircle;
extern const Effect kScaleMismatch;
extern const Effect kSquareness;
extern const Effect kServoMismatch;
extern const Effect kDynamicContraction;
extern const Effect kBacklashA;
extern const Effect kBacklashB;
extern const Effect kReversalSpikeA;
extern const Effect kReversalSpikeB;
extern const Effect kLateralPlayA;
extern const Effect kLateralPlayB;
extern const Effect kCyclicErrorA;
extern const Effect kCyclicErrorB;
extern const Effect kVibration;
extern const Effect kStraightnessA;
extern const Effect kStraightnessB;
extern const Effect kOval;
extern const Effect kLobing;
extern const Effect kSweepDrift;
extern const Effect kCentreDrift;
extern const Effect kMountingSlip;
extern const Effect kBarTemperatureOfRecording;

}  // namespace ballbar::catalogue
