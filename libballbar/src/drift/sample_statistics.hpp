// What the samples of an axis come to.
#pragma once

#include "ballbar/drift/comparison.hpp"

namespace ballbar {

// Deviations, limits of agreement and correlation, from the samples and their sigma.
void describe_samples(AxisComparison& axis, double reference_s);

}  // namespace ballbar
