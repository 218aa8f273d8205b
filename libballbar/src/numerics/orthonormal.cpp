#include "numerics/orthonormal.hpp"

#include <Eigen/QR>
#include <cmath>

namespace ballbar {

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return columns;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  return Eigen::MatrixXd(qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank()));
}

Eigen::VectorXd orthogonal_part(Eigen::VectorXd column, const Eigen::MatrixXd& basis) {
  column -= basis * (basis.transpose() * column);
  return column;
}

Eigen::MatrixXd orthogonal_part(Eigen::MatrixXd columns, const Eigen::MatrixXd& basis) {
  const Eigen::MatrixXd made = basis.transpose() * columns;
  columns -= basis * made;
  return columns;
}

Eigen::RowVectorXd orthonormalise(Eigen::Ref<Eigen::MatrixXd> columns, const Eigen::RowVectorXd& before,
                                  double nothing) {
  Eigen::RowVectorXd square(columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) columns.col(j) -= columns.col(i) * columns.col(i).dot(columns.col(j));
    square[j] = columns.col(j).squaredNorm();
    if (before[j] > 0.0 && square[j] / before[j] > nothing) {
      columns.col(j) /= std::sqrt(square[j]);
    } else {
      columns.col(j).setZero();
    }
  }
  return square;
}

}  // namespace ballbar
