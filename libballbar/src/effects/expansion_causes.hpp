// What a body that grows with its temperature explains of a finite-volume spindle, shared by the expansions.
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
