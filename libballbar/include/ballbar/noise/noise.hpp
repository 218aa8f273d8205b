// What a measurement scatters by when nothing happens: white noise and noise with a memory.
//
//   r_i = s_i + e_i     e white with variance w^2 + sigma_i^2 (sigma_i: stated of row i), s an Ornstein-Uhlenbeck
//   process: variance q^2, correlation exp(-|t_i - t_j| / theta)
//
// On even steps that is ARMA(1,1), without s it is white, without e AR(1); steps may be uneven. The likelihood comes
// from the Kalman filter, O(n). Whitening divides the filter's innovations by their standard deviation: a linear
// operation that is applied to residual and Jacobian alike (generalised least squares). A row whose time is before the
// last one's remembers nothing. Scatter below 1e-9 um counts as 1e-9 um, so that a perfect fit has a likelihood too.
//
// Source of the filter: A. C. Harvey, Forecasting, Structural Time Series Models and the Kalman Filter (1989), ch. 3.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>

namespace ballbar {

struct Noise {
  double white_um = 0.0;            // w
  double correlated_um = 0.0;       // q; 0: none
  double correlation_time_s = 0.0;  // theta
  double log_likelihood = 0.0;
};

// Maximum likelihood; theta between a third of a usual step and the whole time. The memory is kept where it raises
// 2 ln L by more than 4 (two more parameters: Akaike), else the noise is white. sigma_um: stated, one a row, or empty.
// Needs 8 residuals; with fewer they are taken as white. The residual's mean is taken to be 0. 11 000 rows: 10 to 20 ms
// when they are even, 50 ms when not.
//
// fitted: the columns of the Jacobian that was fitted (n by p), or empty. A fit takes the slow part of a noise with
// memory away; with them the likelihood is the restricted one (REML), of what a fit cannot take. The larger p, the
// slower: p = 6 takes some 4 times as long. log_likelihood is always that of the residual.
// Source: D. A. Harville, Maximum likelihood approaches to variance component estimation, J. Am. Stat. Assoc. 72
// (1977).
Noise noise_of(std::span<const double> time_s, std::span<const double> residual_um, std::span<const double> sigma_um,
               const Eigen::MatrixXd& fitted = {});

// Of the normal distribution with this covariance, constants included. noise.log_likelihood is not read.
double log_likelihood(const Noise& noise, std::span<const double> time_s, std::span<const double> residual_um,
                      std::span<const double> sigma_um);

// Number of independent samples whose mean would be as certain: 1' C^-1 1 times the rows' (harmonic) mean variance;
// n for white noise.
double effective_samples(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um);

// Standard deviation of the plain mean of these rows (the residual's memory between them included): exact, O(n).
double sigma_of_mean(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um);

// The smallest RMSE that a true model could leave.
struct Floor {
  double rms_um = 0.0;
  std::string source;  // "3 pairs of repeats", "standstill from 120 to 150 min", "innovations of the residual",
                       // "sigma of the circle fits": a phrase for the report; empty: not known
};

// First of
//   repeats      stretches between changes of speed with the same speeds before and in them, and the same length to a
//                tenth, at least 8 rows: rms of the difference of their targets about its mean, over sqrt 2
//   standstill   at least 20 rows and 10 min after at least 2 h of rest: rms about a straight line, of the longest
//   innovations  rms of what the residual does that the rows before do not tell. Repeatability with a memory is left
//   out
//                of it, because a missing effect looks the same: a true model leaves this at least, and at most
//                sqrt(w^2 + q^2). White residuals leave no difference: the floor is their rms, at least 30 rows
// and never below the rms of the stated sigma. Repeats and standstills that differ by more than 1.25 times what the
// residual's noise has in all are passed over: something the model explains went on in them.
Floor floor_of(std::span<const double> time_s, std::span<const double> target_um, std::span<const double> sigma_um,
               std::span<const double> speed_rpm, const Noise& residual_noise);

}  // namespace ballbar
