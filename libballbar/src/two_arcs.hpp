// Position of the spindle's ball from two orthogonal arcs (drift.hpp has the equations).
#pragma once

#include "ballbar/drift.hpp"

namespace ballbar {

struct TwoArcs {
  Eigen::Vector3d position_um = Eigen::Vector3d::Zero();  // x, y, z from the point where the axes meet
  Eigen::Matrix3d covariance_um2 = Eigen::Matrix3d::Zero();
  Estimate radius_c, radius_a;  // um
  std::size_t discounted = 0;
  bool converged = false;
};

TwoArcs fit_two_arcs(const Recording& c_arc, const Recording& a_arc, const DriftOptions& options);

}  // namespace ballbar
