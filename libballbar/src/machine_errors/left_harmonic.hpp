// What a full model leaves: is it the same in both directions, and has it a form.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_noise.hpp"

namespace ballbar {

// Of CCW less CW at the same angles, over the root of 2, in means over 1 deg; NaN where one direction is missing.
double repeatability_um(const ErrorRows& rows, const Eigen::VectorXd& residual);

// The wave, 5 to 30 a turn, that exceeds the noise most, if it is significant (0.1 %, after their number): of the
// noise that is left beside it, as a wave that was not in the model makes the noise look slower than it is. `columns`:
// those of the model.
std::optional<LeftHarmonic> left_harmonic(const ErrorRows& rows, const Eigen::MatrixXd& columns,
                                          const Eigen::VectorXd& residual, const std::vector<WeightedNoise>& noises);

}  // namespace ballbar
