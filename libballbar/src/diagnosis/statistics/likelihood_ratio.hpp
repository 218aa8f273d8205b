// How likely a residual is under noise with a memory, once what a few columns can make is taken out of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ballbar/noise/noise.hpp"
#include "fit/linearised_fit.hpp"

namespace ballbar {

// Columns J = [model, added] by generalised least squares, the noise by maximum likelihood, in turn. With fewer than 30
// rows the noise is white; where sigma is stated it stays that of `start`, as so few rows tell less than what is
// stated.
struct GlsFit {
  Noise noise;
  double log_likelihood = 0.0;  // at the maximum over gains and noise
  Eigen::VectorXd gains;        // of `added`
  Eigen::VectorXd residual_um;
};
GlsFit gls_fit(const LinearisedFit& linearised, const Eigen::MatrixXd& added, const Noise& start, int rounds = 2);

// As `gls_fit`, but the noise by restricted maximum likelihood: that which a test should use.
Noise restricted_noise(const LinearisedFit& linearised, const Eigen::MatrixXd& added,
                       const Eigen::VectorXd& residual_um);

// Noises that the residual does not tell from `best`: draws from the restricted likelihood about it, each as likely as
// its share. White noise: its variance with n - p degrees of freedom.
std::vector<Noise> plausible_noises(const LinearisedFit& linearised, const Eigen::MatrixXd& added, const Noise& best,
                                    std::size_t count, std::uint64_t seed);

}  // namespace ballbar
