// Distinguishes a jump of the readings (a level shift) from one large change of correlated noise, which decays over the
// correlation time (an innovational outlier; Chen and Liu 1993, J. Am. Stat. Assoc. 88, 284).
#pragma once

#include <cstddef>

#include "diagnosis/posterior/set_regression.hpp"

namespace ballbar {

// Whether a member of a set has an onset and depends on time alone, and a change of the noise there explains the data
// nearly as well: chi^2 differs by less than 4.4 (nine to one).
bool may_be_shock(const Problem& problem, const Posterior& posterior, const EffectSet& set, const SetRegression& at,
                  std::size_t member);

}  // namespace ballbar
