// Slow discrepancies of several lengths and sizes, for a run that is not measured yet.
#pragma once

#include <span>
#include <vector>

#include "noise/linear_filter.hpp"

namespace ballbar {

// The longest stretch in which time goes on.
double span_of_time_s(std::span<const double> time_s);

// This noise beside each of them; of few rows none.
std::vector<Covariance> with_discrepancy(const Covariance& noise, std::span<const double> time_s);

}  // namespace ballbar
