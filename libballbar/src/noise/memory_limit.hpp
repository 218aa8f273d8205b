// Noise with a memory that the record is long enough to show.
#pragma once

#include <Eigen/Core>
#include <span>

#include "ballbar/noise/noise.hpp"

namespace ballbar {

// As noise_of, theta at most `longest_memory_s`: what varies more slowly counts as misfit.
Noise noise_of(std::span<const double> time_s, std::span<const double> residual_um, std::span<const double> sigma_um,
               const Eigen::MatrixXd& fitted, double longest_memory_s);

}  // namespace ballbar
