#include "noise/restricted_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kGroup = 4;        // columns filtered together
constexpr Eigen::Index kBlockRows = 256;  // that stay in the cache

// The products of columns, a whole number of groups, behind the filter, as its gains come.
class FilteredGram {
 public:
  explicit FilteredGram(const RowMajorMatrix& columns)
      : columns_(columns),
        state_(Eigen::RowVectorXd::Zero(columns.cols())),
        white_(kBlockRows, columns.cols()),
        gram_(Eigen::MatrixXd::Zero(columns.cols(), columns.cols())) {}

  void add(const FilterGain& of, Eigen::Index count) {
    using Group = Eigen::Array<double, 1, kGroup>;
    const double keeps = (1.0 - of.gain) * of.decay, scale = std::sqrt(of.weight);
    for (Eigen::Index left = count; left > 0;) {
      const Eigen::Index rows = std::min(left, kBlockRows - filled_);
      for (Eigen::Index k = 0; k < columns_.cols(); k += kGroup) {
        Group s = state_.segment<kGroup>(k);
        for (Eigen::Index i = 0; i < rows; ++i) {
          const Group now = columns_.row(first_ + i).segment<kGroup>(k);
          white_.row(filled_ + i).segment<kGroup>(k) = scale * (now - of.decay * s);
          s = keeps * s + of.gain * now;
        }
        state_.segment<kGroup>(k) = s;
      }
      first_ += rows;
      filled_ += rows;
      left -= rows;
      if (filled_ == kBlockRows) take_up();
    }
  }

  // The upper half.
  const Eigen::MatrixXd& gram() {
    take_up();
    return gram_;
  }

 private:
  void take_up() {
    if (filled_ > 0) gram_.selfadjointView<Eigen::Upper>().rankUpdate(white_.topRows(filled_).transpose());
    filled_ = 0;
  }

  const RowMajorMatrix& columns_;
  Eigen::RowVectorXd state_;
  RowMajorMatrix white_;  // a block of rows
  Eigen::MatrixXd gram_;
  Eigen::Index first_ = 0, filled_ = 0;
};

// What fitted columns leave, of the products of these, white, with a residual behind them (the upper half) and of the
// filter's sum of ln S_i.
LinearFilter::Sums restricted_sums(const Eigen::MatrixXd& gram, double log_variances) {
  const Eigen::Index p = gram.cols() - 1;
  const Eigen::MatrixXd g = gram.topLeftCorner(p, p).selfadjointView<Eigen::Upper>();
  const Eigen::LLT<Eigen::MatrixXd> factor(g);
  const Eigen::VectorXd right = gram.col(p).head(p);
  const Eigen::VectorXd diagonal = factor.matrixLLT().diagonal();
  return {log_variances + 2.0 * diagonal.array().log().sum(), gram(p, p) - right.dot(factor.solve(right))};
}

}  // namespace

RowMajorMatrix unit_basis(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return {columns.rows(), 0};
  const Eigen::VectorXd norm = columns.colwise().norm().transpose().cwiseMax(1e-300);
  return orthonormal(columns * norm.cwiseInverse().asDiagonal());
}

RestrictedLikelihood::RestrictedLikelihood(std::span<const double> residual_um, const RowMajorMatrix& columns)
    : residual_um_(residual_um), p_(columns.cols()) {
  if (p_ == 0) return;
  all_ = RowMajorMatrix::Zero(columns.rows(), (p_ / kGroup + 1) * kGroup);
  all_.leftCols(p_) = columns;
  all_.col(p_) = Eigen::VectorXd::Map(residual_um.data(), columns.rows());
}

LinearFilter::Sums RestrictedLikelihood::sums(const LinearFilter& filter, const Covariance& noise) const {
  if (p_ == 0) return filter.sums(noise, residual_um_);
  FilteredGram filtered(all_);
  const double log_variances =
      filter.for_each_gain(noise, [&](const FilterGain& of, Eigen::Index rows) { filtered.add(of, rows); });
  return restricted_sums(filtered.gram().topLeftCorner(p_ + 1, p_ + 1), log_variances);
}

}  // namespace ballbar
