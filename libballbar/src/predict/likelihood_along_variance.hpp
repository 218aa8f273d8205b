// ln L of ridge.hpp for many v, from one reduction of K = v X~ P X~' + N + u X_m X_m'.
//
// With W'W = N^-1, Z = W (1, y, X~) and P = F F', F' Z'Z F = V T V' with T tridiagonal, so that
//
//   |K| = |N| |I + v T|,   a' K^-1 b = Z_a'Z_b - v c_a' (I + v T)^-1 c_b,   c = V' F' Z'Z_a
//
// and another v takes as many steps as there are predictors, not a factorisation of K. The named terms are removed from
// Z'Z first, likewise. Accurate to 1e-8 of ln L.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "predict/ridge.hpp"

namespace ballbar {

// F of the predictors that have a prior variance.
struct PriorRoot {
  std::vector<Eigen::Index> used;  // 2 for the first predictor: its column of Z
  Eigen::MatrixXd factor;          // F
};
PriorRoot prior_root(const Eigen::MatrixXd& prior);

// Z'Z at one discrepancy.
struct WhiteProducts {
  Eigen::MatrixXd inner;  // 2 + p by 2 + p
  double half_log_determinant = 0.0, degrees = 0.0;
};
// named_variance: u.
WhiteProducts white_products(const RidgeProblem& problem, double length_s, double named_variance);

class LikelihoodAlongVariance {
 public:
  LikelihoodAlongVariance(const WhiteProducts& products, const PriorRoot& root);

  double at(double variance) const;  // ln L

 private:
  Eigen::Matrix2d inner_;  // Z'Z of 1 and y
  double half_log_determinant_, degrees_;
  Eigen::VectorXd diagonal_, beside_;  // of T
  Eigen::MatrixX2d along_;             // c of 1 and y
};

}  // namespace ballbar
