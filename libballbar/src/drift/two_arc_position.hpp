// Position of the spindle's ball from two orthogonal arcs (drift.hpp has the equations).
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "ballbar/drift/drift.hpp"

namespace ballbar {

// x, y, z of the spindle's ball from the point where the axes meet, R_C and R_A less the nominal length; um.
struct TwoArcs {
  Eigen::Vector<double, 5> p;
  Eigen::Matrix<double, 5, 5> covariance_um2;
  Eigen::Matrix<double, 5, 5> inverse_information;  // of the arcs weighted by their noise
  Circle c_circle, a_circle;                        // each arc's own fit: noise, discounted readings
  bool converged = false;

  Estimate coordinate(int i) const;
};

TwoArcs fit_two_arcs(const Recording& c_arc, const Recording& a_arc, const DriftOptions& options);

// Covariance of now.p - reference.p, from the difference of the residuals where the angles are the same, as
// covariance_of_change_um2 of circle_fit.hpp; else the sum of the two covariances.
Eigen::Matrix<double, 5, 5> covariance_of_change_um2(const SessionTest& now, const TwoArcs& now_fit,
                                                     const SessionTest& reference, const TwoArcs& reference_fit,
                                                     const DriftOptions& options);

}  // namespace ballbar
