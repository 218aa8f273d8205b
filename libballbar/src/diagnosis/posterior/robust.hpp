// Readings far from the others, and jumps of the target: what no effect should explain.
//
// The fit sets readings aside that are off the running median (far_readings.hpp). Where the innovations have heavy
// tails, far readings count less, by the weights of Student's t, a mixture of normal distributions (Lange, Little and
// Taylor 1989, J. Am. Stat. Assoc. 84, 881).
//
// Three or more jumps of the residual are a process of the target, such as corrections by the control. Each is a level
// of its own, and none is an effect.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

// Enlarges the variances of the readings that are far from the others, given the covariance and the model. Returns
// false if there are none.
bool weigh_down_outliers(Problem& problem, const LinearModel& linear, const NoiseFilter& filter);

// The rows from which the residual has another level; empty if there are fewer than three.
std::vector<LevelJump> level_jumps(const Problem& problem, const Eigen::VectorXd& residual_um);

// Finds level jumps and outliers of a series beside the richest model, inputs in any form. Beside a poorer model a
// missing effect would make its own readings outliers.
void note_outliers(Problem& problem);

}  // namespace ballbar
