// The noise of a measurement: white noise plus correlated noise.
//
//   r_i = s_i + e_i     e white with variance w^2 + sigma_i^2 (sigma_i: stated of row i), s an Ornstein-Uhlenbeck
//   process: variance q^2, correlation exp(-|t_i - t_j| / theta)
//
// With even steps this is ARMA(1,1), without s white noise, without e AR(1). Steps may be uneven. The likelihood comes
// from the Kalman filter in O(n). Whitening divides the innovations of the filter by their standard deviation. It is a
// linear operation, applied to residual and Jacobian alike (generalised least squares). The correlation restarts at a
// row whose time is before that of the previous row. Standard deviations below 1e-9 um count as 1e-9 um, so that a
// perfect fit has a finite likelihood.
//
// Source of the filter: A. C. Harvey, Forecasting, Structural Time Series Models and the Kalman Filter (1989), ch. 3.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>

#include "ballbar/message.hpp"

namespace ballbar {

struct Noise {
  double white_um = 0.0;            // w
  double correlated_um = 0.0;       // q; 0: none
  double correlation_time_s = 0.0;  // theta
  double log_likelihood = 0.0;
};

// Maximum likelihood estimate; theta lies between a third of a usual step and the length of the record. The correlated
// part is kept if it raises 2 ln L by more than 4 (Akaike, two parameters); else the noise is white. sigma_um: stated
// sigmas, one per row, or empty. The mean of the residual is taken as 0. Fewer than 8 residuals count as white.
// 11 000 rows take 10 to 20 ms if evenly spaced, else 50 ms.
//
// fitted: the columns of the fitted Jacobian (n by p), or empty. A fit absorbs the slow part of correlated noise. With
// `fitted` the restricted likelihood (REML) is used, which corrects for it. The time grows with p: p = 6 takes about 4
// times as long. Noise::log_likelihood is always that of the residual itself.
// Source: D. A. Harville, Maximum likelihood approaches to variance component estimation, J. Am. Stat. Assoc. 72
// (1977).
Noise noise_of(std::span<const double> time_s, std::span<const double> residual_um, std::span<const double> sigma_um,
               const Eigen::MatrixXd& fitted = {});

// ln of the normal likelihood of the residual with this noise, constants included. Does not read noise.log_likelihood.
double log_likelihood(const Noise& noise, std::span<const double> time_s, std::span<const double> residual_um,
                      std::span<const double> sigma_um);

// Effective number of samples: the number of independent samples whose mean has the same variance. It is 1' C^-1 1
// times the harmonic mean variance of the rows; n for white noise.
double effective_samples(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um);

// Standard deviation of the unweighted mean of these rows, correlation included. Exact, O(n).
double sigma_of_mean(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um);

// The noise level: the smallest RMSE that a true model could reach.
struct Floor {
  double rms_um = 0.0;
  Paragraph source;  // a phrase for the report: "3 pairs of repeats", "standstill from 120 to 150 min",
                     // "error of predicting the next reading", "sigma of the circle fits"; empty: not known
};

// Estimates the noise level from the first available source:
//   repeats      stretches between changes of speed with the same speed before and in them, and the same length within
//                a tenth, at least 8 rows: rms of the difference of their targets about its mean, over sqrt 2
//   standstill   the longest one with at least 20 rows and 10 min after at least 2 h of rest: rms about a straight line
//   innovations  rms of the part of the residual that earlier rows do not predict, at least 30 rows. It excludes the
//                correlated noise, because a missing effect looks the same. A true model leaves at least this, and at
//                most sqrt(w^2 + q^2). For white residuals it is their rms.
// The result is never below the rms of the stated sigma. Repeats and standstills with more than 1.25 times the total
// noise of the residual are ignored: an effect of the model acts in them.
Floor floor_of(std::span<const double> time_s, std::span<const double> target_um, std::span<const double> sigma_um,
               std::span<const double> speed_rpm, const Noise& residual_noise);

}  // namespace ballbar
