// All that the evidence of a line needs of the readings at one covariance: products of white columns.
#pragma once

#include <Eigen/Core>

#include "diagnosis/evidence/covariance.hpp"

namespace ballbar {

struct Gram {
  Eigen::Index rows = 0;         // n
  double log_determinant = 0.0;  // of the covariance
  Eigen::MatrixXd pool;          // P by P
};

// pool: n by P.
Gram gram_of(const CovarianceFilter& filter, const RowMajorMatrix& pool);

}  // namespace ballbar
