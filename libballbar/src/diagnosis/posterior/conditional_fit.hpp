// The most likely parameters of the model with a given set of effects.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/linearisation.hpp"
#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

struct ConditionalFit {
  std::vector<std::size_t> signatures;  // the set
  std::vector<double> parameters;       // of the model, in their own units
};

// From the parameters of the linearisation, the shapes of the set held.
ConditionalFit conditional_fit(const Problem& problem, const Linearisation& linearisation,
                               const std::vector<std::size_t>& signatures, const NoiseFilter& filter);

// With the shapes of the set free, from the best of several parameters of the model. Adds these shapes to the library,
// and replaces the signatures of the set by them. Without this, another effect would explain the residual of a strong
// effect whose true shape lies between two points of the grid.
ConditionalFit sharpened(Problem& problem, const Linearisation& linearisation, std::vector<std::size_t> signatures,
                         const std::vector<std::vector<double>>& starts, const NoiseFilter& filter);

}  // namespace ballbar
