// A grid of noise models: white, and with correlation times from a step to a sixth of the record, with or without a
// slow discrepancy.
#pragma once

#include <span>
#include <vector>

#include "noise/linear_filter.hpp"

namespace ballbar {

// Noise alone: white, and with memories from a step to a sixth of the time, from mostly white to hardly white. Few
// rows: white alone.
std::vector<Covariance> noise_grid(std::span<const double> time_s);

// About this noise, between it and its neighbours of the grid.
std::vector<Covariance> noises_about(const Covariance& noise, std::span<const double> time_s);

// This noise beside a discrepancy of several lengths and sizes.
std::vector<Covariance> with_discrepancy(const Covariance& noise, std::span<const double> time_s);

}  // namespace ballbar
