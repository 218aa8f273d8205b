// A jump of the readings, or one large change of noise with a memory, which dies away over it: a level shift or an
// innovational outlier (Chen and Liu 1993, J. Am. Stat. Assoc. 88, 284).
#pragma once

#include <cstddef>

#include "diagnosis/posterior/set_at.hpp"

namespace ballbar {

// Whether a member of a set begins at a moment (time alone, an onset), and such a change there would do nearly as well:
// chi^2 of the member is less by under 4.4, which is nine to one.
bool may_be_shock(const Problem& problem, const Posterior& posterior, const EffectSet& set, const SetAt& at,
                  std::size_t member);

}  // namespace ballbar
