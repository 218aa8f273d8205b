// Covariance of a least-squares solution under an autocorrelated residual: what H and S of circle.hpp need.
#pragma once

#include <Eigen/Core>

#include "numerics/row_blocks.hpp"

namespace ballbar::least_squares {

// rho(k) = share * phi^k for k > 0, rho(0) = 1: ARMA(1,1). White: phi = share = 0.
struct Autocorrelation {
  double phi = 0.0;
  double share = 0.0;
};

// From the residual's autocorrelation at lags 1 to 8: phi by least squares of r(k+1) on r(k), share = r(1) / phi.
// White where r(1) is below 3 / sqrt(n), or negative: an interval is never narrowed.
Autocorrelation autocorrelation_of(const Eigen::ArrayXd& residual);

// H = sum J_i J_i' and S = sum_ij rho(|i-j|) J_i J_j' over readings in their order, by one recursion.
template <int P>
struct Information {
  Eigen::Matrix<double, P, P> white = Eigen::Matrix<double, P, P>::Zero();
  Eigen::Matrix<double, P, P> correlated = Eigen::Matrix<double, P, P>::Zero();
};

template <int P, class Rows>
Information<P> information_of(const Rows& rows, const Eigen::Vector<double, P>& p, const Autocorrelation& rho) {
  Information<P> information;
  Eigen::Matrix<double, P, P> lagged = Eigen::Matrix<double, P, P>::Zero();
  Eigen::Vector<double, P> memory = Eigen::Vector<double, P>::Zero();  // sum over k > 0 of phi^k J_(i-k)
  for_each_block<P>(rows, p, [&](Eigen::Index, const auto& part) {
    for (int i = 0; i < P; ++i) {
      for (int j = i; j < P; ++j) information.white(i, j) += part.col(i).dot(part.col(j));
    }
    if (rho.share == 0.0) return;
    for (Eigen::Index i = 0; i < part.rows(); ++i) {
      const Eigen::Vector<double, P> row = part.row(i).template head<P>();
      lagged.noalias() += row * memory.transpose();
      memory = rho.phi * (memory + row);
    }
  });
  information.white.template triangularView<Eigen::StrictlyLower>() = information.white.transpose();
  information.correlated = information.white + rho.share * (lagged + lagged.transpose());
  return information;
}

}  // namespace ballbar::least_squares
