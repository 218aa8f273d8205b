// The agreement of the samples of an axis, one by one.
#pragma once

#include "ballbar/drift/compare.hpp"

namespace ballbar {

// Sets counted, within, agreement, samples_agree and deviation from the differences and their sigma, without the
// reference.
void decide_by_samples(AxisComparison& axis, double reference_s);

// Statistics of the samples of an axis.

// Deviations, limits of agreement and correlation, from the samples and their sigma.
void describe_samples(AxisComparison& axis, double reference_s);

}  // namespace ballbar
