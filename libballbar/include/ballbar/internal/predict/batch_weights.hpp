// Weights the recorded batches by their similarity to a given job, so that a regression is trained on those like it:
//
//   w_k = exp(-d_k^2 / (2 h^2)),  d_k^2 = sum_f ((f_job - f_k) / s_f)^2
//
// The features f are room temperature, mean and spread of the sensors at the start of the test, and the mean speed if
// logged. s_f is their standard deviation over the batches. h and the settings of the regression are chosen by
// cross-validation: the 30 batches most similar to the job are each left out and predicted in the same way. Weights are
// relative to the largest; those below 0.05 are set to 0, except for the nearest three.
#pragma once

#include <span>
#include <vector>

#include "ballbar/predict/train.hpp"

namespace ballbar {

struct BatchWeights {
  std::vector<double> distance;  // d_k of each batch
  std::vector<double> weight;    // w_k
  double bandwidth = 0.0;        // h; infinite: equal weights
  RegressionSettings settings;   // of the regression with these weights
};

// Uses the start conditions of `job`. Throws Error for fewer than 3 batches.
BatchWeights batch_weights(std::span<const Batch> batches, const BatchStart& job, RegressionMethod method);

}  // namespace ballbar
