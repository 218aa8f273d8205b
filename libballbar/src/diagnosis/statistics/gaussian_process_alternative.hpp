// The alternative to every named cause: some smooth curve, nothing more.
//
// residual = J p + f + s + e: f a Gaussian process with the Matern 3/2 covariance
//   A^2 (1 + sqrt(3) |dt| / l) exp(-sqrt(3) |dt| / l),
// s and e the noise of noise.hpp. Likelihood by a Kalman filter with three states, O(n); J by generalised least
// squares. Source: J. Hartikainen, S. Sarkka, Kalman filtering and smoothing solutions to temporal Gaussian process
// regression models, MLSP 2010.
#pragma once

#include "diagnosis/statistics/likelihood_ratio.hpp"

namespace ballbar {

struct GaussianProcessAlternative {
  double amplitude_um = 0.0;  // A
  double length_s = 0.0;      // l
  Noise noise;
  double log_likelihood = 0.0;
};

// The most likely; log_likelihood compares with that of gls_fit(linearised, {}, ...).
GaussianProcessAlternative gaussian_process_alternative(const LinearisedFit& linearised, const Noise& start);

// ln of the likelihood with these values, J at its most likely.
double log_likelihood(const LinearisedFit& linearised, const Noise& noise, double amplitude_um, double length_s);

}  // namespace ballbar
