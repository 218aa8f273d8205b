// All that the evidence of any set of effects needs of the readings at one covariance: products of white columns.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "diagnosis/evidence/covariance.hpp"

namespace ballbar {

struct Gram {
  Eigen::Index rows = 0;         // n
  double log_determinant = 0.0;  // of the covariance
  Eigen::MatrixXd pool;          // P by P
  Eigen::MatrixXd cross;         // P by C
  Eigen::VectorXd squares;       // C
};

// pool: n by P; signatures: n by C, C may be 0.
Gram gram_of(const CovarianceFilter& filter, const RowMajorMatrix& pool, const RowMajorMatrix& signatures);

// Products of some signatures with one another, K by K.
Eigen::MatrixXd products_of(const CovarianceFilter& filter, const RowMajorMatrix& signatures,
                            std::span<const Eigen::Index> chosen);

}  // namespace ballbar
