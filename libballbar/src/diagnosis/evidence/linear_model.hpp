// The Gaussian linear model of the readings, and its solution at one covariance.
//
//   y = X a + E u + eps      a flat; u ~ N(0, 1) um; eps ~ N(0, s^2 C)
//
// s is integrated over 1 / s, or over its stated prior. With Z = [X E] and P = diag(0, s^2), of white rows:
//
//   ln p = - 1/2 ln |C| - 1/2 ln |Z' Z + P| + (columns of E) ln s - nu/2 ln S + ...
//   S = y' y - y' Z (Z' Z + P)^-1 Z' y,   nu = n - columns of X
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "noise/whitening.hpp"
#include "numerics/log_sum.hpp"

namespace ballbar {

struct LinearModel {
  RowMajorMatrix columns;     // n by 1 + p: y, then the columns of X and of E in any order
  std::vector<char> is_flat;  // p: of X
};

// The model with more columns, n by k.
LinearModel with_columns(LinearModel model, const Eigen::MatrixXd& columns, bool are_flat);

// The products of the white columns, from which everything follows.
struct Gram {
  Eigen::Index rows = 0;         // n, readings
  double log_determinant = 0.0;  // of C
  Eigen::MatrixXd products;      // 1 + p by 1 + p, y first
};
Gram gram_of(const Whitening& whitening, const RowMajorMatrix& columns);
Gram gram_of_white(const Whitening& whitening, const RowMajorMatrix& white);  // of columns that are white already

// Z' Z + P as D^-1 L L' D^-1, D the lengths that make its diagonal 1.
class NormalFactor {
 public:
  NormalFactor() = default;
  NormalFactor(Eigen::MatrixXd products, const Eigen::VectorXd& precision);  // p by p; diagonal of P
  // L^-1 D Z'x of columns x. The sum of squares of each is what the model explains of x.
  Eigen::MatrixXd explained(const Eigen::Ref<const Eigen::MatrixXd>& products) const;
  Eigen::VectorXd coefficients(const Eigen::VectorXd& explained) const;
  Eigen::MatrixXd inverse() const;  // of Z' Z + P
  double half_log_determinant() const { return half_log_determinant_; }

 private:
  Eigen::VectorXd scale_;
  Eigen::MatrixXd lower_;  // L
  double half_log_determinant_ = 0.0;
};

// P: s^2 of the columns of E, 0 of those of X.
Eigen::VectorXd precision_of(const std::vector<char>& is_flat, double variance);

// The prior of the scatter: equivalent to this many readings with this variance, in units of C.
struct KnownScatter {
  double readings = 0.0, variance = 0.0;
};

struct LinearSolution {
  double degrees = 0.0;       // nu
  double square = 0.0;        // S
  double variance = 0.0;      // estimate of s^2
  double log_evidence = 0.0;  // but for a constant of n and nu
  Eigen::VectorXd coefficients;
  NormalFactor factor;
  // Of the coefficients, um^2.
  Eigen::MatrixXd covariance() const { return variance * factor.inverse(); }
};
// s^2 is estimated.
LinearSolution linear_solution(const Gram& gram, const std::vector<char>& is_flat, const KnownScatter& known);
// s^2 is given; log_evidence stays 0.
LinearSolution solution_at(const Gram& gram, const std::vector<char>& is_flat, double variance);
LinearSolution linear_solution(const Whitening& whitening, const LinearModel& model, const KnownScatter& known);

// The readings less what the model makes of them, in um.
Eigen::VectorXd residual_of(const LinearModel& model, const LinearSolution& solution);

}  // namespace ballbar
