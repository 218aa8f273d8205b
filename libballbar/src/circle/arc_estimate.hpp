// Centre and radius of an arc whose path has an oval: one Gaussian linear model about a circle that is fitted already.
//
//   y = X b + Z u + e,    b flat,    u ~ N(0, s^2 I),    e ~ N(0, v V)
//
//   y   residual of the fitted circle; X its derivatives by centre and radius; b what is to be added to these
//   Z   the oval, cos 2 theta and sin 2 theta: scale mismatch of the axes, squareness, servo mismatch
//   V   white noise and an Ornstein-Uhlenbeck memory (linear_filter.hpp), readings equally spaced in time
//
// On a full circle Z is orthogonal to X. On an arc it is not: an oval of 2 um moves the least-squares centre of 120 deg
// by 6 um. Given s and V, b and its covariance are those of generalised least squares with the prior (Rasmussen and
// Williams, Gaussian Processes for Machine Learning (2006), eq. 2.41 and 2.42). s, the memory and its share are summed
// over a grid, each point with its likelihood (b and u integrated out); v is the residual variance of X and Z together.
#pragma once

#include <Eigen/Core>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// The usual size of an oval, um: standard deviation of each of its two amplitudes. The grid of s is from half of it to
// four times. From measured tests: scale mismatch and squareness make 0.3 to 0.8 um at 50 mm, 1.4 um at 100 mm; 2 um at
// 100 mm is a mismatch of 8 um over the diameter, or a squareness of 40 um/m. A servo mismatch does not grow with the
// radius: 0.5 um.
double usual_oval_um(double radius_mm);

// Readings as means of up to a few neighbours: [X Z y], um.
struct ArcRows {
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> columns;
};

struct ArcEstimate {
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  Eigen::Vector2d oval_um = Eigen::Vector2d::Zero();  // u
  Eigen::Matrix3d covariance_um2 = Eigen::Matrix3d::Zero();
  double autocorrelation = 0.0;     // of neighbouring rows, by the likeliest memory; 0: white
  double effective_share = 1.0;     // independent rows over rows, for the worst of b without an oval
};

ArcEstimate arc_estimate(const ArcRows& rows, double oval_um);

}  // namespace ballbar
