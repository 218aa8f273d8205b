// Centre and radius of an arc whose path has an oval: one Gaussian linear model about a circle that is fitted already.
//
//   y = X b + Z u + e,    b flat,    u ~ N(0, sizes^2),    e ~ N(0, v V)
//
//   y   residual of the fitted circle; X its derivatives by centre and radius; b what is to be added to these
//   Z   the form of the path: the oval, cos 2 theta and sin 2 theta (scale mismatch, squareness, servo mismatch), and
//       the third harmonic (straightness, backlash)
//   V   white noise and an Ornstein-Uhlenbeck memory (linear_filter.hpp), readings equally spaced in time
//
// On a full circle Z is orthogonal to X. On an arc it is not: an oval of 2 um moves the least-squares centre of 120 deg
// by up to 6 um. Given the sizes and V, b and its covariance are those of generalised least squares with a prior
// (Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), section 2.7). The sizes, the memory and its
// share are summed over a grid, each point with its likelihood (b and u integrated out); v is the variance that X and Z
// leave.
#pragma once

#include <Eigen/Core>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// The usual size of an oval, um: standard deviation of each of its two amplitudes, 20 um/m of the radius and 0.5 um (a
// servo mismatch does not grow with the radius), together 2.1 um at 100 mm. The grid goes from half of it to four
// times. Two measured tests have amplitudes of 0.8 and 0.3 um at 50 mm, 1.4 um at 100 mm; 2 um at 100 mm is 8 um of
// scale mismatch, or 40 um/m of squareness. The third harmonic is 0 on most paths, else 0.25 or 0.7 of the usual oval.
double usual_oval_um(double radius_mm);

// Readings, or means of as many neighbours: [X Z y], um.
struct ArcRows {
  static constexpr int kColumns = 8;
  Eigen::Matrix<double, Eigen::Dynamic, kColumns, Eigen::RowMajor> columns;
};

struct ArcEstimate {
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  Eigen::Vector4d u = Eigen::Vector4d::Zero();
  Eigen::Matrix3d covariance_um2 = Eigen::Matrix3d::Zero();
  double autocorrelation = 0.0;  // of neighbouring rows, by the likeliest memory; 0: white
  double effective_share = 1.0;  // independent rows over rows, for the worst of b without an oval
};

ArcEstimate arc_estimate(const ArcRows& rows, double oval_um);

}  // namespace ballbar
