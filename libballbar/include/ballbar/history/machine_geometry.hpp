// Squareness of a machine's planes and the scales of its axes, from one test a plane or more.
//
// A test of the plane of axes A and B tells both scales, with the covariance C of its own fit:
//
//   (s_A, s_B)' = (scale of A, scale of B)' + e,     cov e = C
//
// All tests together: weighted least squares for the axes they reach. An axis in two planes is measured twice; how far
// both agree is chi^2, and the pull of each is its residual over the residual's sigma. Where they agree worse than one
// in a hundred would by chance, each scale of a test is taken to scatter by as much more as makes chi^2 the degrees of
// freedom. A bar of wrong length moves all scales by as much: that no test of its own shows.
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
  double p_value = 1.0;            // that so many tests differ so much by chance; below 0.01 the sigma is widened
};

struct AxisScale {
  int axis = 0;  // 0, 1, 2 of X, Y, Z
  double value_ppm = 0.0;
  double sigma_ppm = 0.0;  // NaN: of stored values
  std::size_t planes = 0;  // that it is measured in
};

struct ScalePull {
  std::string file;  // of the test
  Plane plane = Plane::XY;
  int axis = 0;
  double value_ppm = 0.0, sigma_ppm = 0.0;  // of that test
  double pull = 0.0;                        // residual over its sigma; NaN: only this test tells the axis
};

// Whether the tests agree.
struct ScaleAgreement {
  double chi2 = 0.0;
  std::size_t degrees = 0;  // 0: nothing to compare
  double p_value = 1.0;
  double scatter_ppm = 0.0;  // of each scale of a test beyond its sigma, where the tests disagree
  std::vector<ScalePull> pulls;
};

struct MachineGeometry {
  std::vector<std::size_t> tests;  // that all of this is from, by plane and date
  bool within_a_day = true;
  std::vector<PlaneSquareness> squareness;
  std::vector<AxisScale> scales;
  ScaleAgreement agreement;
};

// The tests within a day before the newest; of a plane without one there, its newest. Tests with a sigma go before
// stored values, dated ones before others. Tests without squareness and scales are passed over.
MachineGeometry machine_geometry(std::span<const MachineTest> tests);

}  // namespace ballbar
