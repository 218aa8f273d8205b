// The rounds of a fit: starts, robust weights, noise.
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

// A few steps from every start, then to the end from the best of them. Throws Error where the model is finite nowhere.
Minimum best_of(const FitProblem& problem, const Weighting& weighting, const std::vector<Eigen::VectorXd>& starts);

// How the rows are weighted where those discounted are left out of the noise's filter.
using WeightingWithout = std::function<Weighting(const std::vector<std::size_t>& discounted)>;

// Weighted again and again by what is left (Tukey), until the weights stay. A row that turns out to be an outlier is
// left out of the filter in the next round, so that it does not discount the rows after it.
SolvedFit reweighted(const FitProblem& problem, const WeightingWithout& weighting_without, SolvedFit solved);

struct Whitened {
  SolvedFit solved;
  Noise noise;
  bool misfit = false;  // then `solved` is as it was
};

// The fit again with the noise of what it left, some rounds. What is discounted counts in no noise. `data`: times and
// sigma.
Whitened whitened(const FitProblem& problem, const Fit& data, const SolvedFit& least_squares, bool robust);

// White noise with what was stated taken off.
Noise white_noise(const std::vector<double>& left_um, const std::vector<double>& sigma_um, std::size_t free);

std::vector<double> vector_of(const Eigen::VectorXd& values);
double rms_of(const std::vector<double>& values);

}  // namespace ballbar
