// A sum of single effects averaged over the covariances at which the readings are likely, and over its modes.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/posterior.hpp"
#include "diagnosis/posterior/search.hpp"

namespace ballbar {

// grid: covariances of noise; is_given: these and no others.
Posterior averaged(Problem& problem, std::size_t largest, Searched searched, const std::vector<Covariance>& grid,
                   bool is_given);

}  // namespace ballbar
