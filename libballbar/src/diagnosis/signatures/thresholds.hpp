// Thresholds of a diagnosis that several files use; the others are in the file that uses them.
//
// d: root of the fall of chi^2. ln: natural logarithm of a likelihood. P, shares: 0 to 1.
#pragma once

#include <array>
#include <cstddef>

#include "ballbar/diagnosis/signatures/search.hpp"

namespace ballbar {

// Detectability of an effect before any residual is examined.
inline constexpr double kFound = 7.0;      // d from which a diagnosis finds an effect
inline constexpr double kAbsorbed = 0.05;  // remaining share of a signature's square below which it is absorbed

// Of so many readings or fewer an input in any form explains all.
inline constexpr std::size_t kFewReadings = 60;

// d of a gain, with equal priors.
inline constexpr std::array<double, 9> kGainSizes{4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 1024.0, 4096.0};

// Verdict.
inline constexpr double kMinor = 0.05;  // share of the RMSE

}  // namespace ballbar
