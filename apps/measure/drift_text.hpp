// What is said of a drift series.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"

namespace ballbar {

using DriftMember = std::optional<Estimate> DriftPoint::*;
struct DriftQuantity {
  const char* name;
  DriftMember member;
};
std::span<const DriftQuantity> drift_quantities();   // x, y, z, radial, axial
std::span<const DriftQuantity> radius_quantities();  // what must not change

bool any_has(const DriftSeries& series, DriftMember member);

// "y 30.1 ± 0.0 um at 64 min": the largest of each quantity that the series has.
std::vector<std::string> largest_drifts(const DriftSeries& series);

}  // namespace ballbar
