// The covariances at which the readings are likely: of a grid those that the sets of effects are weighed at.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

// The noise is what the richest model leaves, every input in any form: what it says of each covariance goes into the
// prior. Kept are, the likeliest first, those at which no effect, one, or, where a set may have several, a strong one
// with another make the readings nearly as likely as at the best. variant: the model about its fit.
std::vector<Point> likely_points(const Problem& problem, const Variant& variant, std::size_t largest_set);

}  // namespace ballbar
