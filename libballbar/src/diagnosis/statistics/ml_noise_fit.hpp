// A fit with its most likely noise: what the likelihood ratio of an effect is made of.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/statistics/likelihood_ratio.hpp"

namespace ballbar {

// Model fitted to as many rows as are tested, and what of it is linear.
struct NoiseFit {
  Fit fit;
  LinearisedFit linearised;
  Noise noise;  // most likely
  double log_likelihood = 0.0;
  std::vector<std::size_t> fold;  // of every row that was fitted
  bool of_recordings = false;
};

// By the fit's own noise, then in turn by the most likely one (fit() keeps plain least squares where a memory is long),
// as long as that is more likely. Throws Error as fit does.
NoiseFit noise_fit(const Model& model, const Series& data, std::size_t target);

// By this noise.
NoiseFit noise_fit_by(const Noise& noise, const Model& model, const Series& data, std::size_t target);

// The model with its free parameters starting from where the fit has them.
Model from_where_it_is(Model model, const Fit& fit);

}  // namespace ballbar
