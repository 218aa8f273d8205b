// A plant that is made otherwise: quantities alone, without recordings, by conventions of its own. Nothing of the
// laboratory is in it, so that the history is not judged by the scatter and the stories it was made with.
//
//   scatter    half of its variance is the same for months: the same person sets up alike
//   values     rounded to 0.1 um and 1 um/m; on every fourth machine without sigma
//   tests      monthly on half of the machines, quarterly on the others; two on one day now and then
//   names      one machine is spelt otherwise from its second year on: another machine, which has no story
//   stories    wear that quickens, a crash that takes two months to show, a hall that is warm for half of the year, a
//              ball screw, and a bar that is exchanged on six machines
#pragma once

#include <cstdint>

#include "fleet/tally.hpp"

namespace ballbar::study {

struct OtherPlantOptions {
  std::uint64_t seed = 1;
  bool stories = true;
};

Plant other_plant_of(const OtherPlantOptions& options);

}  // namespace ballbar::study
