// The residual noise of the full model of a ballbar test, and the variance of sums of readings.
//
// White (w^2 per reading) and correlated (Ornstein-Uhlenbeck: q^2, theta). A row is a mean of c readings dt apart;
// with h = dt / (2 theta), k = sinh(c h) / (c sinh h):
//
//   cov of two rows   q^2 k_i k_j exp(-|t_i - t_j| / theta)
//   variance of one   q^2 f + w^2 / c,      f = 1/c^2 (c + 2 sum over m of (c - m) exp(-m dt / theta))
//
// The restricted likelihood (REML) is computed on a grid of theta and of w / q, its amplitude analytically:
//
//   -2 ln L = (n - p) ln(s^2) + ln det V + ln det(X' V^-1 X),      s^2 = r' V^-1 r / (n - p)
//
// and all points of the grid are weighted by their likelihood; the best point alone would underestimate the
// uncertainty.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ballbar/noise/noise.hpp"
#include "machine_errors/error_rows.hpp"

namespace ballbar {

struct WeightedNoise {
  double weight = 0.0;  // they sum to 1
  Noise noise;          // white_um a reading
};

// From the deviation and the fitted columns, row by row. Sorted by falling weight; unlikely points are left out.
std::vector<WeightedNoise> error_noise(const ErrorRows& rows, const Eigen::MatrixXd& columns);

// Rows beyond the reach of a reversal, two of a recording joined to one, with the means of columns: what the noise is
// learnt from. Near a reversal the form of a spike is never quite that of the model, and the residual there is no
// noise.
struct QuietRows {
  ErrorRows rows;
  Eigen::MatrixXd columns;
};
QuietRows quiet_rows(const ErrorRows& rows, const Eigen::MatrixXd& columns);

// By how much the readings within the reach of each reversal scatter more than those of none, a factor for each row; 1
// where that is not clear. Readings up to 1.5 deg after a reversal are left out: they are single ones.
Eigen::VectorXd excess_of(const ErrorRows& rows, const Eigen::VectorXd& residual);

// V Z of columns Z (rows by k), V over all points of the grid.
Eigen::MatrixXd spread_of(const Eigen::MatrixXd& columns, const ErrorRows& rows,
                          const std::vector<WeightedNoise>& noises);

// Z' V Z of columns that hold the weight of each row.
Eigen::MatrixXd scatter_of(const Eigen::MatrixXd& columns, const ErrorRows& rows,
                           const std::vector<WeightedNoise>& noises);

// Of these rows alone, ascending and of one recording.
Eigen::MatrixXd covariance_of(const ErrorRows& rows, const std::vector<Eigen::Index>& which, const Noise& noise);

// The variance of one reading for which a mean of many independent readings would scatter as observed; for slow
// columns.
double slow_variance_um2(const ErrorRows& rows, const std::vector<WeightedNoise>& noises);

}  // namespace ballbar
