// The causes of a finite-volume spindle that thermal expansion of a body explains, shared by the expansion effects.
#pragma once

#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

inline std::vector<ExplainedCause> expansion_causes() {
  return {{SpindleCause::rings, true},
          {SpindleCause::housing, true},
          {SpindleCause::structure, true},
          {SpindleCause::bending, true}};
}

}  // namespace ballbar
