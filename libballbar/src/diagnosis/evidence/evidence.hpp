// How likely the readings are under a set of effects, at one covariance.
//
//   y = X a + E e + G g + scatter       scatter: s^2 C, s not known
//
// a: flat; e ~ N(0, 1) um; g ~ N(0, d^2 s^2) in units in which what is left of a column of G beside X and E has length
// 1, d one of several; s integrated over 1 / s, or over what is stated of it. With S what is left of |y|^2 in the white
// rows, nu = n - columns of X:
//
//   ln p = - 1/2 ln |C| - 1/2 ln |A' A| - nu/2 ln S + ...
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "diagnosis/evidence/gram.hpp"

namespace ballbar {

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
  double square = 0.0;    // S with no effect
  double variance = 0.0;  // s^2 by it
  KnownScatter known;
  Eigen::MatrixXd cross;         // p by C: what the line makes of each signature
  Eigen::VectorXd along, left;   // C: y's part along what is left of a signature, and the square of that
  Eigen::VectorXd coefficients;  // of the line with no effect

  double log_likelihood(double square_left) const;
};
Solved solved(const Gram& gram, const Line& line, const KnownScatter& known);

// Adds to Solved::constant + ...: of some columns, products of what is left of them and with y.
// share: of d^2 that each column has, 1 for effects, 1 / k for k columns that make one curve together.
double log_evidence(const Solved& base, const Eigen::MatrixXd& left, const Eigen::VectorXd& along, double share = 1.0);
double log_evidence(const Solved& base, double left, double along);  // of one column
double log_evidence(const Solved& base);                             // of none

// Of two columns of one gain each: products of what is left of them, with y. -infinity: they are nearly one.
double log_evidence_of_two(const Solved& base, double aa, double bb, double ab, double along_a, double along_b);

// Of the forms of one input: all of them together, each with its share, or any two alone, both alike.
double log_evidence_of_forms(const Solved& base, const Eigen::MatrixXd& left, const Eigen::VectorXd& along);

}  // namespace ballbar
