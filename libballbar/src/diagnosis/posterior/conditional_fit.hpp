// The most likely parameters of the model with a given set of effects.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/posterior/linearisation.hpp"
#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

struct ConditionalFit {
  std::vector<std::size_t> signatures;  // the set
  std::vector<double> parameters;       // of the model, in their own units
  Eigen::MatrixXd delays;  // n by k: of the model's inputs, and of steps in the set's (BaseModel::delays_at)
};

// Fits the model beside the set from the parameters of the linearisation. The shapes of the set are held.
ConditionalFit conditional_fit(const Problem& problem, const Linearisation& linearisation,
                               const std::vector<std::size_t>& signatures, const NoiseFilter& filter);

// Fits the model and the shapes of the set together, from each of these parameters of the model, and keeps the best
// fit. The fitted shapes are added to the library and replace the signatures of the set. Without this, another effect
// would explain the residual of a strong effect whose true shape lies between two points of the grid.
ConditionalFit sharpened(Problem& problem, const Linearisation& linearisation, std::vector<std::size_t> signatures,
                         const std::vector<std::vector<double>>& starts, const NoiseFilter& filter);

// Fits the shape of each signature alone beside a linear model, and adds it to the library if it is another one.
void sharpen_beside(Problem& problem, const LinearModel& beside, const std::vector<std::size_t>& signatures,
                    const NoiseFilter& filter);

}  // namespace ballbar
