// Thresholds of a diagnosis that callers print or use. Thresholds that only the library uses are in its sources.
//
// d: root of the fall of chi^2. ln: natural logarithm of a likelihood. P, shares: 0 to 1.
#pragma once

#include <cstddef>

namespace ballbar {

// Detectability of an effect before any residual is examined.
inline constexpr double kDetectable = 5.0;    // d
inline constexpr double kIdentifiable = 7.5;  // d

// Tests of a member of a set.
inline constexpr double kLeastLikelihoodRatio = 10.0;  // 2 ln of a likelihood ratio; 10 is about 150 to 1

// Verdict.
inline constexpr double kNamed = 0.9;        // P
inline constexpr double kProbable = 0.8;     // P
inline constexpr double kNothing = 0.5;      // P of nothing from which the verdict is `nothing`
inline constexpr double kSureDriver = 0.9;   // P
inline constexpr double kDiscrepancy = 0.5;  // P of a slow drift without a cause from which it is reported

// Effects of a model.
inline constexpr double kDropTest = 0.05;  // an effect is needed if P that it is not is smaller

// The next test.
inline constexpr double kSureEnough = 0.95;    // P(right) of a test from which no longer test is considered
inline constexpr double kSureOfNothing = 0.8;  // P of nothing from which no test is planned

}  // namespace ballbar
