// Slow discrepancies of several lengths and sizes, for a run that is not measured yet.
#pragma once

#include <span>
#include <vector>

#include "noise/linear_filter.hpp"

namespace ballbar {

// This noise beside each of them; of few rows none.
std::vector<Covariance> with_discrepancy(const Covariance& noise, std::span<const double> time_s);

}  // namespace ballbar
