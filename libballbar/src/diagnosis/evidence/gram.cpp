#include "diagnosis/evidence/gram.hpp"

namespace ballbar {

Gram gram_of(const CovarianceFilter& filter, const RowMajorMatrix& pool) {
  Gram result;
  result.rows = pool.rows();
  result.log_determinant = filter.log_determinant();
  RowMajorMatrix white = pool, state = RowMajorMatrix::Zero(3, pool.cols());
  filter.apply(0, white, state);
  result.pool = Eigen::MatrixXd::Zero(pool.cols(), pool.cols());
  result.pool.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
  result.pool.triangularView<Eigen::StrictlyUpper>() = result.pool.transpose();
  return result;
}

}  // namespace ballbar
