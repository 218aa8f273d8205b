// How likely the readings are under a line, at one covariance.
//
//   y = X a + E e + scatter       scatter: s^2 C, s not known
//
// a: flat; e ~ N(0, 1) um; s integrated over 1 / s, or over what is stated of it. With S what is left of |y|^2 in the
// white rows, nu = n - columns of X:
//
//   ln p = - 1/2 ln |C| - 1/2 ln |A' A| - nu/2 ln S + ...
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "noise/whitening.hpp"

namespace ballbar {

// All that the evidence of a line needs of the readings at one covariance: products of white columns.
struct Gram {
  Eigen::Index rows = 0;         // n
  double log_determinant = 0.0;  // of the covariance
  Eigen::MatrixXd pool;          // P by P
};

// pool: n by P.
Gram gram_of(const Whitening& whitening, const RowMajorMatrix& pool);

double log_sum(std::span<const double> logarithms);  // ln of the sum of e^x

// Columns of a pool that make a line.
struct Line {
  Eigen::Index y = 0;
  std::vector<Eigen::Index> columns;
  std::vector<char> is_free;  // of each: flat, or N(0, 1) um
};

// What is known of the scatter beforehand: as if so many readings had this variance, in units of C.
struct KnownScatter {
  double readings = 0.0, variance = 0.0;
};

struct Solved {
  double constant = 0.0;  // of ln p, without the scatter
  double degrees = 0.0;   // nu
  double square = 0.0;    // S
  double variance = 0.0;  // s^2 by it
  KnownScatter known;
  Eigen::VectorXd coefficients;  // of the line

  double log_likelihood(double square_left) const;
};
Solved solved(const Gram& gram, const Line& line, const KnownScatter& known);

double log_evidence(const Solved& solved);

}  // namespace ballbar
