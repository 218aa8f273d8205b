#include "noise/restricted_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kGroup = 4;        // columns filtered together
constexpr Eigen::Index kBlockRows = 128;  // that stay in the cache

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

  bool has_all() const { return first_ == columns_.rows(); }

  // The lower half.
  const Eigen::MatrixXd& gram() {
    take_up();
    return gram_;
  }

 private:
  void take_up() {
    // Group by group: of so few columns this is faster than a product of matrices, which packs them first.
    using Group = Eigen::Array<double, 1, kGroup>;
    for (Eigen::Index a = 0; a < white_.cols(); a += kGroup) {
      for (Eigen::Index b = a; b < white_.cols(); b += kGroup) {
        Group sum[kGroup] = {Group::Zero(), Group::Zero(), Group::Zero(), Group::Zero()};
        for (Eigen::Index i = 0; i < filled_; ++i) {
          const double* left = &white_(i, a);
          const Group right = white_.row(i).segment<kGroup>(b);
          for (Eigen::Index k = 0; k < kGroup; ++k) sum[k] += left[k] * right;
        }
        for (Eigen::Index k = 0; k < kGroup; ++k) gram_.col(a + k).segment<kGroup>(b) += sum[k].matrix().transpose();
      }
    }
    filled_ = 0;
  }

  const RowMajorMatrix& columns_;
  Eigen::RowVectorXd state_;
  RowMajorMatrix white_;  // a block of rows
  Eigen::MatrixXd gram_;
  Eigen::Index first_ = 0, filled_ = 0;
};

// What fitted columns leave, of the products of these, white, with a residual behind them (the lower half) and of the
// filter's sum of ln S_i.
LinearFilter::Sums restricted_sums(const Eigen::MatrixXd& gram, double log_variances) {
  const Eigen::Index p = gram.cols() - 1;
  const Eigen::LLT<Eigen::MatrixXd> factor(gram.topLeftCorner(p, p));
  const Eigen::VectorXd white = factor.matrixL().solve(gram.row(p).head(p).transpose());
  return {log_variances + 2.0 * factor.matrixLLT().diagonal().array().log().sum(), gram(p, p) - white.squaredNorm()};
}

}  // namespace

RowMajorMatrix unit_basis(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return {columns.rows(), 0};
  const Eigen::VectorXd norm = columns.colwise().norm().transpose().cwiseMax(1e-300);
  return orthonormal(columns * norm.cwiseInverse().asDiagonal());
}

RestrictedLikelihood::RestrictedLikelihood(std::span<const double> residual_um, const RowMajorMatrix& columns,
                                           std::span<const std::size_t> starts)
    : residual_um_(residual_um), p_(columns.cols()) {
  if (p_ == 0) return;
  std::vector<Eigen::Index> ends;
  for (const std::size_t start : starts) {
    if (start > 0) ends.push_back(static_cast<Eigen::Index>(start));
  }
  ends.push_back(columns.rows());
  Eigen::Index first = 0;
  for (const Eigen::Index end : ends) {
    const auto rows = columns.middleRows(first, end - first);
    Part part;
    for (Eigen::Index k = 0; k < p_; ++k) {
      if (!rows.col(k).isZero(0.0)) part.columns.push_back(k);
    }
    const auto p = static_cast<Eigen::Index>(part.columns.size());
    part.values = RowMajorMatrix::Zero(rows.rows(), (p / kGroup + 1) * kGroup);
    part.values.leftCols(p) = rows(Eigen::all, part.columns);
    part.values.col(p) = Eigen::VectorXd::Map(residual_um.data() + first, rows.rows());
    part.columns.push_back(p_);
    parts_.push_back(std::move(part));
    first = end;
  }
}

LinearFilter::Sums RestrictedLikelihood::sums(const LinearFilter& filter, const Covariance& noise) const {
  if (p_ == 0) return filter.sums(noise, residual_um_);
  std::vector<FilteredGram> filtered;
  filtered.reserve(parts_.size());
  for (const Part& part : parts_) filtered.emplace_back(part.values);
  auto now = filtered.begin();
  const double log_variances = filter.for_each_gain(noise, [&](const FilterGain& of, Eigen::Index rows) {
    if (now->has_all()) ++now;
    now->add(of, rows);
  });
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(p_ + 1, p_ + 1);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const std::vector<Eigen::Index>& of = parts_[k].columns;
    const auto size = static_cast<Eigen::Index>(of.size());
    gram(of, of) += filtered[k].gram().topLeftCorner(size, size);
  }
  return restricted_sums(gram, log_variances);
}

}  // namespace ballbar
