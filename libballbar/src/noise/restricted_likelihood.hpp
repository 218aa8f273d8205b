// Restricted likelihood (REML, noise.hpp) of correlated noise, for a residual after fitting columns.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "noise/whitening.hpp"

namespace ballbar {

// An orthonormal basis of columns of any length, row after row.
RowMajorMatrix unit_basis(const Eigen::MatrixXd& columns);

// Of one residual (n, referred to) and orthonormal columns X (n by p), for one filter and noise after the other.
class RestrictedLikelihood {
 public:
  // starts: rows, rising, at which the filter remembers nothing. Where a column is 0 from one of them to the next, it
  // is not filtered.
  RestrictedLikelihood(std::span<const double> residual_um, const RowMajorMatrix& columns,
                       std::span<const std::size_t> starts = {});

  // G = X' C^-1 X and g = X' C^-1 r take g' G^-1 g from the squares r' C^-1 r and add ln det G to the variances
  // ln det C: -1/2 their sum is ln of the likelihood, up to a constant. noise: without a discrepancy.
  LinearFilter::Sums sums(const LinearFilter& filter, const Covariance& noise) const;

  Eigen::Index columns() const { return p_; }

 private:
  // Rows from one start to the next.
  struct Part {
    std::vector<Eigen::Index> columns;  // those that are not 0, and p for the residual
    RowMajorMatrix values;              // of these, and zeros up to whole groups
  };

  std::span<const double> residual_um_;
  Eigen::Index p_ = 0;
  std::vector<Part> parts_;  // empty where p is 0
};

}  // namespace ballbar
