// Likelihood of a noise with a memory, restricted to what fitted columns leave of a residual (REML, noise.hpp).
#pragma once

#include <Eigen/Core>
#include <span>

#include "noise/whitening.hpp"

namespace ballbar {

// An orthonormal basis of columns of any length, row after row.
RowMajorMatrix unit_basis(const Eigen::MatrixXd& columns);

// Of one residual (n, referred to) and orthonormal columns X (n by p), for one filter and noise after the other.
class RestrictedLikelihood {
 public:
  RestrictedLikelihood(std::span<const double> residual_um, const RowMajorMatrix& columns);

  // G = X' C^-1 X and g = X' C^-1 r take g' G^-1 g from the squares r' C^-1 r and add ln det G to the variances
  // ln det C: -1/2 their sum is ln of the likelihood, up to a constant. noise: without a discrepancy.
  LinearFilter::Sums sums(const LinearFilter& filter, const Covariance& noise) const;

  Eigen::Index columns() const { return p_; }

 private:
  std::span<const double> residual_um_;
  Eigen::Index p_ = 0;
  RowMajorMatrix all_;  // X, the residual behind it, and zeros up to whole groups; empty where p is 0
};

}  // namespace ballbar
