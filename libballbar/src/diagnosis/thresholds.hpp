// Thresholds of a diagnosis that more than one file needs; the others stand in the file that uses them.
//
// d: root of the fall of chi^2. ln: of a likelihood. P, shares: 0 to 1.
#pragma once

#include <array>
#include <cstddef>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {

// Inputs as they were logged.
inline constexpr double kJumpTime = 0.35;   // sd of when in its sample an input changed, in samples
inline constexpr double kClockTime = 0.6;   // sd of how late a clock is, in samples
inline constexpr double kUnknownRow = 1e6;  // variance of a reading that tells nothing, of the others'

// Detectability: what a signature could show, before any residual is looked at.
inline constexpr double kFound = 7.0;      // d from which a diagnosis finds an effect
inline constexpr double kAbsorbed = 0.05;  // share of a signature's square: with less left it is the model's

// Priors.
inline constexpr std::size_t kMostEffects = 8;                                         // of a sum of single effects
inline constexpr std::array<double, 6> kGainSizes{4.0, 8.0, 16.0, 32.0, 64.0, 128.0};  // d of a gain, alike

// Tests of a member of a set.
inline constexpr double kSameGain = 0.01;  // p_same_gain below which gains differ

// Verdict.
inline constexpr double kNothing = 0.5;      // P of nothing from which nothing is said
inline constexpr double kSureDriver = 0.9;   // P
inline constexpr double kDiscrepancy = 0.5;  // P of a slow drift without a cause from which it is said
inline constexpr double kMinor = 0.05;       // of the RMSE

// A run that is followed.
inline constexpr double kFalselyDecided = 0.02;   // of runs in which nothing is hidden, at most; of what is decided
inline constexpr std::size_t kLooksToDecide = 3;  // in a row that say the same

// The next test.
inline constexpr double kSureEnough = 0.95;    // P(right) of a test from which no longer one is looked for
inline constexpr double kSureOfNothing = 0.8;  // P of nothing from which no test is looked for

}  // namespace ballbar
