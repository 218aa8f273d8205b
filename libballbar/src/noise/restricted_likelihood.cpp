#include "noise/restricted_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/orthonormal.hpp"

namespace ballbar {

RowMajorMatrix unit_basis(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return {columns.rows(), 0};
  const Eigen::VectorXd norm = columns.colwise().norm().transpose().cwiseMax(1e-300);
  return orthonormal(columns * norm.cwiseInverse().asDiagonal());
}

RestrictedLikelihood::RestrictedLikelihood(std::span<const double> time_s, std::span<const double> residual_um,
                                           std::span<const double> sigma_um, RowMajorMatrix columns)
    : kalman_(time_s, sigma_um), residual_um_(residual_um), columns_(std::move(columns)) {}

Kalman::Sums RestrictedLikelihood::sums(const NoiseVariances& noise) {
  kalman_.set(noise);
  Kalman::Sums sums = kalman_.sums(residual_um_);
  const Eigen::Index p = columns_.cols();
  if (p == 0) return sums;
  constexpr Eigen::Index kBlockRows = 256;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(p + 1, p + 1);
  Eigen::RowVectorXd predicted = Eigen::RowVectorXd::Zero(p + 1);
  innovations_.resize(std::min(kBlockRows, columns_.rows()), p + 1);
  for (Eigen::Index first = 0; first < columns_.rows(); first += kBlockRows) {
    const Eigen::Index rows = std::min(kBlockRows, columns_.rows() - first);
    auto block = innovations_.topRows(rows);
    block.leftCols(p) = columns_.middleRows(first, rows);
    block.col(p) = Eigen::VectorXd::Map(residual_um_.data() + first, rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      filter_row(kalman_.decay()[first + i], kalman_.gain()[first + i], std::sqrt(kalman_.weight()[first + i]),
                 block.row(i), predicted);
    }
    gram.selfadjointView<Eigen::Upper>().rankUpdate(block.transpose());
  }
  const Eigen::MatrixXd g = gram.topLeftCorner(p, p).selfadjointView<Eigen::Upper>();
  const Eigen::LLT<Eigen::MatrixXd> factor(g);
  const Eigen::VectorXd right = gram.col(p).head(p);
  const Eigen::VectorXd diagonal = factor.matrixLLT().diagonal();
  sums.log_variances += 2.0 * diagonal.array().log().sum();
  sums.squares -= right.dot(factor.solve(right));
  return sums;
}

}  // namespace ballbar
