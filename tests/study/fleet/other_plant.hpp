// A plant that is made otherwise: quantities alone, without recordings, by conventions of its own.
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
  double block_share = 0.5;  // of the scatter's variance that stays for months
  bool quarterly = true;     // every second machine
  bool heavy_tails = true;
  std::size_t machines = 40;
};

Plant other_plant_of(const OtherPlantOptions& options);

}  // namespace ballbar::study
