#include "diagnosis/evidence/gram.hpp"

#include <algorithm>

namespace ballbar {
namespace {

constexpr Eigen::Index kRowsTogether = 128, kColumnsTogether = 192;  // a quarter of a megabyte at a time

}  // namespace

Gram gram_of(const CovarianceFilter& filter, const RowMajorMatrix& pool, const RowMajorMatrix& signatures) {
  const Eigen::Index n = pool.rows(), p = pool.cols(), c = signatures.cols();
  Gram result;
  result.rows = n;
  result.log_determinant = filter.log_determinant();
  RowMajorMatrix white_pool = pool, pool_state = RowMajorMatrix::Zero(3, p);
  filter.apply(0, white_pool, pool_state);
  result.pool = Eigen::MatrixXd::Zero(p, p);
  result.pool.selfadjointView<Eigen::Lower>().rankUpdate(white_pool.transpose());
  result.pool.triangularView<Eigen::StrictlyUpper>() = result.pool.transpose();
  result.cross = Eigen::MatrixXd::Zero(p, c);
  result.squares = Eigen::VectorXd::Zero(c);
  for (Eigen::Index left = 0; left < c; left += kColumnsTogether) {
    const Eigen::Index width = std::min(kColumnsTogether, c - left);
    RowMajorMatrix state = RowMajorMatrix::Zero(3, width);
    for (Eigen::Index first = 0; first < n; first += kRowsTogether) {
      const Eigen::Index rows = std::min(kRowsTogether, n - first);
      RowMajorMatrix block = signatures.block(first, left, rows, width);
      filter.apply(static_cast<std::size_t>(first), block, state);
      result.cross.middleCols(left, width).noalias() += white_pool.middleRows(first, rows).transpose() * block;
      result.squares.segment(left, width) += block.colwise().squaredNorm().transpose();
    }
  }
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
