// Squareness of a machine's planes and scale errors of its axes, from one or more tests per plane.
//
// A test in the plane of axes A and B measures both scales, with the covariance C of its own fit:
//
//   (s_A, s_B)' = (scale of A, scale of B)' + e,     cov e = C
//
// All tests together give the scales by weighted least squares. An axis that lies in two planes is measured twice.
// chi^2 tells how well the measurements agree; the pull of each is its residual over the sigma of the residual. If the
// agreement is worse than 1 % by chance, a common scatter is added to each scale of a test, so that chi^2 equals the
// degrees of freedom. A wrong length of the bar changes all scales alike; the tests cannot show it.
//
// Source of the scatter: R. C. Paule and J. Mandel, J. Res. Natl. Bur. Stand. 87 (1982).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballbar/history/machine_test.hpp"

namespace ballbar {

struct PlaneSquareness {
  Plane plane = Plane::XY;
  double value = 0.0;
  double sigma = 0.0;  // NaN: of stored values
  std::string unit;
  std::vector<std::size_t> tests;
  std::vector<std::string> files;  // of these
  double p_value = 1.0;            // of equal values in all tests; below 0.01 the sigma is widened
};

struct AxisScale {
  int axis = 0;  // 0, 1, 2 of X, Y, Z
  double value_ppm = 0.0;
  double sigma_ppm = 0.0;  // NaN: of stored values
  std::size_t planes = 0;  // number of planes in which it is measured
};

struct ScalePull {
  std::string file;  // of the test
  Plane plane = Plane::XY;
  int axis = 0;
  double value_ppm = 0.0, sigma_ppm = 0.0;  // of that test
  double pull = 0.0;                        // residual over its sigma; NaN: only this test measures the axis
};

// Whether the tests agree.
struct ScaleAgreement {
  double chi2 = 0.0;
  std::size_t degrees = 0;  // 0: nothing to compare
  double p_value = 1.0;
  double scatter_ppm = 0.0;  // added to each scale of a test if the tests disagree
  std::vector<ScalePull> pulls;
};

struct MachineGeometry {
  std::vector<std::size_t> tests;  // indices of the tests used, by plane and date
  bool within_a_day = true;
  std::vector<PlaneSquareness> squareness;
  std::vector<AxisScale> scales;
  ScaleAgreement agreement;
};

// Uses the tests within a day before the newest; for a plane without one, its newest test. Tests with a sigma take
// precedence over stored values, dated ones over others. Tests without squareness and scales are ignored.
MachineGeometry machine_geometry(std::span<const MachineTest> tests);

}  // namespace ballbar
