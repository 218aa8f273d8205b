// How well a mean-value point is known: its place from a profile whose temperatures have a sigma.
#pragma once

#include <vector>

#include "ballbar/temperature/mean_point.hpp"

namespace ballbar {

// Two sigma of T, without what all places share, where it first is at the level: crossings between which T stays within
// that are one point. 0 where sigma is not known or T never is at the level.
double same_degC(const TemperatureProfile& profile, double level_degC);

// With the standard uncertainty of a scale read in steps, step / root 12, in the sigma of T at each place.
TemperatureProfile with_step(TemperatureProfile profile, double step_degC);

// The most forgiving of a misplaced sensor first.
std::vector<MeanPoint> flattest_first(std::vector<MeanPoint> points);

// sigma of xi = hypot(sigma of T over its slope, edge_sigma_mm, half the stretch over which T cannot be told from the
// mean); edge_sigma_mm of the profile's ends. NaN where the sigma of T is not known.
double sigma_of_place_mm(const TemperatureProfile& profile, const MeanPoint& point, double edge_sigma_mm);

}  // namespace ballbar
