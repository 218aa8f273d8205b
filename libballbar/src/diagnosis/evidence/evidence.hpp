// The evidence (marginal likelihood) of the readings under a linear model, at one covariance.
//
//   y = X a + E e + scatter       scatter: s^2 C, s not known
//
// a has a flat prior; e ~ N(0, 1) um; s is integrated over 1 / s, or over its stated prior. With S the residual sum of
// squares of the white rows and nu = n - columns of X:
//
//   ln p = - 1/2 ln |C| - 1/2 ln |A' A| - nu/2 ln S + ...
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "noise/whitening.hpp"

namespace ballbar {

// The products of white columns from which the evidence of any linear model follows, at one covariance.
struct Gram {
  Eigen::Index rows = 0;         // n, readings
  double log_determinant = 0.0;  // of the covariance
  Eigen::MatrixXd pool;          // P by P
};

// pool: n by P.
Gram gram_of(const Whitening& whitening, const RowMajorMatrix& pool);

double log_sum(std::span<const double> logarithms);  // ln of the sum of e^x

// The columns of a pool that form a linear model of its first column.
struct Line {
  std::vector<Eigen::Index> columns;
  std::vector<char> is_free;  // per column: flat prior, or N(0, 1) um
};

// The prior of the scatter: equivalent to this many readings with this variance, in units of C.
struct KnownScatter {
  double readings = 0.0, variance = 0.0;
};

struct LinearSolution {
  double constant = 0.0;  // part of ln p without the scatter
  double degrees = 0.0;   // nu
  double square = 0.0;    // S
  double variance = 0.0;  // estimate of s^2
  KnownScatter known;
  Eigen::VectorXd coefficients;  // of the linear model

  double log_likelihood(double square_left) const;
};
LinearSolution linear_solution(const Gram& gram, const Line& line, const KnownScatter& known);

double log_evidence(const LinearSolution& solved);

}  // namespace ballbar
