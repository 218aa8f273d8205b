// The one list of effects.
#include <algorithm>
#include <array>

#include "effects/catalogue.hpp"

namespace ballbar {
namespace {

constexpr std::array kEffects = {
    // on a drift series
    &catalogue::kExpansion,
    &catalogue::kLaggedExpansion,
    &catalogue::kSpeedHeating,
    &catalogue::kCentrifugalShift,
    &catalogue::kCoolingAsymmetry,
    &catalogue::kViscosityFeedback,
    &catalogue::kLoadHeating,
    &catalogue::kGradientBending,
    &catalogue::kBearingRings,
    &catalogue::kBearingClearance,
    &catalogue::kPreloadLoss,
    &catalogue::kAxialCrosstalk,
    &catalogue::kPlayHysteresis,
    &catalogue::kThermostatCycle,
    &catalogue::kDayCycle,
    &catalogue::kSettling,
    &catalogue::kLinearDrift,
    &catalogue::kStep,
    &catalogue::kBarTemperature,
    &catalogue::kClockOffset,
    // on a recording
    &catalogue::kCircle,
    &catalogue::kScaleMismatch,
    &catalogue::kSquareness,
    &catalogue::kServoMismatch,
    &catalogue::kDynamicContraction,
    &catalogue::kBacklashA,
    &catalogue::kBacklashB,
    &catalogue::kReversalSpikeA,
    &catalogue::kReversalSpikeB,
    &catalogue::kLateralPlayA,
    &catalogue::kLateralPlayB,
    &catalogue::kCyclicErrorA,
    &catalogue::kCyclicErrorB,
    &catalogue::kVibration,
    &catalogue::kStraightnessA,
    &catalogue::kStraightnessB,
    &catalogue::kOval,
    &catalogue::kLobing,
    &catalogue::kSweepDrift,
    &catalogue::kCentreDrift,
    &catalogue::kMountingSlip,
    &catalogue::kBarTemperatureOfRecording,
};

}  // namespace

bool applies_to(const Effect& effect, Motion motion) {
  return effect.motions.empty() ||
         std::find(effect.motions.begin(), effect.motions.end(), motion) != effect.motions.end();
}

std::span<const Effect* const> effects() { return kEffects; }

const Effect* find_effect(std::string_view name, Level level) {
  const auto* const effect = std::find_if(kEffects.begin(), kEffects.end(), [&](const Effect* candidate) {
    return candidate->name == name && candidate->level == level;
  });
  return effect == kEffects.end() ? nullptr : *effect;
}

}  // namespace ballbar
