// Thresholds of a diagnosis that its callers print, or go on by; those of the library alone stand in its sources.
//
// d: root of the fall of chi^2. ln: of a likelihood. P, shares: 0 to 1.
#pragma once

#include <cstddef>

namespace ballbar {

// Detectability: what a signature could show, before any residual is looked at.
inline constexpr double kDetectable = 5.0;    // d
inline constexpr double kIdentifiable = 7.5;  // d

// Tests of a member of a set.
inline constexpr double kLeastLikelihoodRatio = 10.0;  // 2 ln of a ratio of likelihoods: 150 to 1
inline constexpr std::size_t kSurrogates = 200;

// Verdict.
inline constexpr double kNamed = 0.9;     // P
inline constexpr double kProbable = 0.8;  // P

// A run that is followed.
inline constexpr std::size_t kFirstLook = 64;   // values of the target
inline constexpr std::size_t kMostLooks = 100;  // the last at 177 000 values

// Effects of a model.
inline constexpr double kDropTest = 0.05;  // P that one is not needed, below which it is

}  // namespace ballbar
