#include "diagnosis/evidence/gram.hpp"

#include <algorithm>

namespace ballbar {
namespace {

constexpr Eigen::Index kRowsTogether = 32;

}  // namespace

Gram gram_of(const CovarianceFilter& filter, const RowMajorMatrix& pool, const RowMajorMatrix& signatures) {
  const Eigen::Index n = pool.rows(), p = pool.cols(), c = signatures.cols();
  Gram result;
  result.rows = n;
  result.log_determinant = filter.log_determinant();
  result.pool = Eigen::MatrixXd::Zero(p, p);
  result.cross = Eigen::MatrixXd::Zero(p, c);
  result.squares = Eigen::VectorXd::Zero(c);
  RowMajorMatrix pool_state = RowMajorMatrix::Zero(3, p), state = RowMajorMatrix::Zero(3, c);
  for (Eigen::Index first = 0; first < n; first += kRowsTogether) {
    const Eigen::Index rows = std::min(kRowsTogether, n - first);
    RowMajorMatrix own = pool.middleRows(first, rows);
    filter.apply(static_cast<std::size_t>(first), own, pool_state);
    result.pool.selfadjointView<Eigen::Lower>().rankUpdate(own.transpose());
    if (c == 0) continue;
    RowMajorMatrix block = signatures.middleRows(first, rows);
    filter.apply(static_cast<std::size_t>(first), block, state);
    result.cross.noalias() += own.transpose() * block;
    result.squares += block.colwise().squaredNorm().transpose();
  }
  result.pool.triangularView<Eigen::StrictlyUpper>() = result.pool.transpose();
  return result;
}

Eigen::MatrixXd products_of(const CovarianceFilter& filter, const RowMajorMatrix& signatures,
                            std::span<const Eigen::Index> chosen) {
  const Eigen::Index n = signatures.rows(), c = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(c, c);
  RowMajorMatrix state = RowMajorMatrix::Zero(3, c);
  constexpr Eigen::Index kBlock = 128;
  for (Eigen::Index first = 0; first < n; first += kBlock) {
    const Eigen::Index rows = std::min(kBlock, n - first);
    RowMajorMatrix block(rows, c);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double* row = &signatures(first + i, 0);
      for (Eigen::Index k = 0; k < c; ++k) block(i, k) = row[chosen[static_cast<std::size_t>(k)]];
    }
    filter.apply(static_cast<std::size_t>(first), block, state);
    result.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
  }
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  return result;
}

}  // namespace ballbar
