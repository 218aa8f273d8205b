#include "diagnosis/next_test/discrimination.hpp"

#include <Eigen/QR>

#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

Eigen::MatrixXd triangular(const Eigen::MatrixXd& columns) {
  if (columns.rows() <= columns.cols()) return columns;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.matrixQR().topRows(columns.cols()).triangularView<Eigen::Upper>();
}

}  // namespace

Eigen::MatrixXd whitened_factor(const Eigen::MatrixXd& columns, const Whitening& whitening) {
  return triangular(whitened(whitening, columns));
}

Eigen::MatrixXd both(const Eigen::MatrixXd& first, const Eigen::MatrixXd& columns, const Whitening& whitening) {
  Eigen::MatrixXd stacked(first.rows() + columns.rows(), first.cols());
  stacked << first, whitened(whitening, columns);
  return triangular(stacked);
}

double distance(const Eigen::MatrixXd& factor, Eigen::Index signal, const std::vector<Eigen::Index>& columns) {
  std::vector<Eigen::Index> used;
  for (const Eigen::Index column : columns) {
    if (factor.col(column).norm() > 0.0) used.push_back(column);
  }
  Eigen::MatrixXd basis = factor(Eigen::all, used);
  for (Eigen::Index k = 0; k < basis.cols(); ++k) basis.col(k).normalize();
  basis = orthonormal(basis);
  const Eigen::VectorXd a = factor.col(signal);
  // Twice, for the digits that the first lost.
  return freed(freed(a, basis), basis).norm();
}

}  // namespace ballbar
