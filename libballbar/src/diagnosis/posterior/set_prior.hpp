// How probable a set of effects is before any reading: ln of it.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

// Of all sets of so many effects together.
double log_prior_of_size(std::size_t size);

// Effects alike, columns of an effect alike; sets of more effects less likely. own: as Variant::own.
double log_prior_of_set(const Problem& problem, const std::vector<std::size_t>& families, std::size_t own);

}  // namespace ballbar
