// Whether the samples of an axis agree, one by one.
#pragma once

#include "ballbar/drift/comparison.hpp"

namespace ballbar {

// counted, within, agreement, samples_agree and deviation, from the differences and their sigma; the reference does not
// count.
void decide_by_samples(AxisComparison& axis, double reference_s);

// What the samples of an axis come to.

// Deviations, limits of agreement and correlation, from the samples and their sigma.
void describe_samples(AxisComparison& axis, double reference_s);

}  // namespace ballbar
