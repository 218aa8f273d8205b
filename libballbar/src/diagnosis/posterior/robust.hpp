// Readings far from the others, and jumps of the target: what no effect should explain.
//
// The fit sets readings aside that are off the running median (far_readings.hpp). Where the innovations have heavy
// tails, readings count as in Student's t with four degrees of freedom, a mixture of normal distributions (Lange,
// Little and Taylor 1989, J. Am. Stat. Assoc. 84, 881).
//
// Three or more jumps of the residual are a process of the target, such as corrections by the control. Each is a level
// of its own, and none is an effect.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

// The residual of the readings in the first column of the pool, beside the line.
Eigen::VectorXd residual_beside(const Problem& problem, const Variant& variant, const Point& point);

// Makes the variances of readings larger that are far from the others, given the covariance and the line beside it.
// False: there are none.
bool weigh_down_outliers(Problem& problem, const Variant& variant, const Point& point);

// Where the residual has another level; fewer than three: none.
std::vector<LevelJump> level_jumps(const Problem& problem, const Eigen::VectorXd& residual_um);

}  // namespace ballbar
