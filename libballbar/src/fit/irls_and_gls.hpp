// The iterations of a fit: starts, robust weights (IRLS), noise (GLS).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "fit/series_cost.hpp"

namespace ballbar {

struct FitProblem {
  const ModelRows& rows;
  const Eigen::VectorXd& target_um;
  const Bounds& bounds;
  std::size_t free = 0;
};

struct SolvedFit {
  Minimum minimum;
  Weighting weighting;
  std::vector<std::size_t> discounted;
};

// A few steps from every start, then the full fit from the best one. Throws Error if the model is not finite at any
// start.
Minimum best_of(const FitProblem& problem, const Weighting& weighting, const std::vector<Eigen::VectorXd>& starts);

// The weighting of the rows, with discounted rows left out of the filter of the noise.
using WeightingWithout = std::function<Weighting(const std::vector<std::size_t>& discounted)>;

// Repeats the fit with Tukey weights of the residual until the weights converge. An outlier is left out of the filter
// in the next iteration, so that it does not affect the rows after it.
SolvedFit reweighted(const FitProblem& problem, const WeightingWithout& weighting_without, SolvedFit solved);

struct WhitenedFit {
  SolvedFit solved;
  Noise noise;
  bool misfit = false;  // `solved` is then unchanged
};

// Repeats the fit with the noise of its residual, for some iterations. Discounted rows do not count for the noise.
// `data`: times and sigmas.
WhitenedFit whitened(const FitProblem& problem, const Fit& data, const SolvedFit& least_squares, bool robust);

// White noise without the stated part.
Noise white_noise(const std::vector<double>& left_um, const std::vector<double>& sigma_um, std::size_t free);

std::vector<double> vector_of(const Eigen::VectorXd& values);
double rms_of(const std::vector<double>& values);

}  // namespace ballbar
