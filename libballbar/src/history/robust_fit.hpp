// Least squares with Huber's loss, for values with known scatter.
//
//   minimise 2 sum rho((y_i - x_i' b) / s_i),    rho(z) = z^2 / 2 up to |z| = c, c |z| - c^2 / 2 beyond, c = 2
//
// by iterative weights, starting from ordinary least squares. The loss is convex and has one minimum.
//
// Source: P. J. Huber, Robust Statistics (1981), chapter 7.
#pragma once

#include <Eigen/Core>
#include <span>

namespace ballbar {

inline constexpr double kHuberClip = 2.0;
inline constexpr Eigen::Index kMostColumns = 5;

using FitColumns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Eigen::Dynamic, kMostColumns>;
using FitNormal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostColumns, kMostColumns>;
using FitGains = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostColumns, 1>;

struct RobustFit {
  FitGains gains;
  FitNormal covariance;    // of the gains, for independent values with scatter s_i
  Eigen::VectorXd scores;  // (y_i - x_i' b) / s_i, not clipped
  double loss = 0.0;       // 2 sum rho: as chi^2
};

inline double clipped(double z, double clip) { return z > clip ? clip : z < -clip ? -clip : z; }

// n rows, at most kMostColumns columns, n values, n scatters above 0.
RobustFit robust_fit(const FitColumns& columns, std::span<const double> values, std::span<const double> scatter);

// The columns of the curves that are fitted to values over time.

// 1, and years since the middle of the dates.
FitColumns trend_columns(std::span<const double> time_s);

// sin and cos of the time of the year, counted from 1970-01-01T00:00:00.
FitColumns season_columns(std::span<const double> time_s);

// 0 before index k, 1 from it on.
FitColumns step_column(std::size_t n, std::size_t k);

// The columns of both sets.
FitColumns joined(const FitColumns& left, const FitColumns& right);

}  // namespace ballbar
