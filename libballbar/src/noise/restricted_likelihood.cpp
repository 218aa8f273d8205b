#include "noise/restricted_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kGroup = 4;        // columns filtered together
constexpr Eigen::Index kBlockRows = 256;  // that stay in the cache

// The products of columns, a whole number of groups, behind the filter; the upper half.
Eigen::MatrixXd gram_of(const std::vector<Kalman::Gain>& gains, const RowMajorMatrix& columns) {
  using Group = Eigen::Array<double, 1, kGroup>;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(columns.cols());
  RowMajorMatrix white(kBlockRows, columns.cols());
  const auto add = [&](Eigen::Index rows) {
    gram.selfadjointView<Eigen::Upper>().rankUpdate(white.topRows(rows).transpose());
  };
  Eigen::Index first = 0, filled = 0;
  for (const Kalman::Gain& of : gains) {
    const double keeps = (1.0 - of.gain) * of.decay, scale = std::sqrt(of.weight);
    for (Eigen::Index left = of.rows; left > 0;) {
      const Eigen::Index rows = std::min(left, kBlockRows - filled);
      for (Eigen::Index k = 0; k < columns.cols(); k += kGroup) {
        Group s = state.segment<kGroup>(k);
        for (Eigen::Index i = 0; i < rows; ++i) {
          const Group now = columns.row(first + i).segment<kGroup>(k);
          white.row(filled + i).segment<kGroup>(k) = scale * (now - of.decay * s);
          s = keeps * s + of.gain * now;
        }
        state.segment<kGroup>(k) = s;
      }
      first += rows;
      filled += rows;
      left -= rows;
      if (filled < kBlockRows) continue;
      add(filled);
      filled = 0;
    }
  }
  if (filled > 0) add(filled);
  return gram;
}

}  // namespace

RowMajorMatrix unit_basis(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return {columns.rows(), 0};
  const Eigen::VectorXd norm = columns.colwise().norm().transpose().cwiseMax(1e-300);
  return orthonormal(columns * norm.cwiseInverse().asDiagonal());
}

RestrictedLikelihood::RestrictedLikelihood(std::span<const double> time_s, std::span<const double> residual_um,
                                           std::span<const double> sigma_um, const RowMajorMatrix& columns)
    : kalman_(time_s, sigma_um), residual_um_(residual_um), p_(columns.cols()) {
  if (p_ == 0) return;
  all_ = RowMajorMatrix::Zero(columns.rows(), (p_ / kGroup + 1) * kGroup);
  all_.leftCols(p_) = columns;
  all_.col(p_) = Eigen::VectorXd::Map(residual_um.data(), columns.rows());
}

Kalman::Sums RestrictedLikelihood::sums(const NoiseVariances& noise) {
  kalman_.set(noise);
  Kalman::Sums sums = kalman_.sums(residual_um_);
  if (p_ == 0) return sums;
  const Eigen::MatrixXd gram = gram_of(kalman_.gains(), all_);
  const Eigen::MatrixXd g = gram.topLeftCorner(p_, p_).selfadjointView<Eigen::Upper>();
  const Eigen::LLT<Eigen::MatrixXd> factor(g);
  const Eigen::VectorXd right = gram.col(p_).head(p_);
  const Eigen::VectorXd diagonal = factor.matrixLLT().diagonal();
  sums.log_variances += 2.0 * diagonal.array().log().sum();
  sums.squares -= right.dot(factor.solve(right));
  return sums;
}

}  // namespace ballbar
