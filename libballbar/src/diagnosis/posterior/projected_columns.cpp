#include "diagnosis/posterior/projected_columns.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ballbar {
namespace {

constexpr double kSurviving = 1e-3;            // smallest share of a column's square orthogonal to the model
constexpr Eigen::Index kColumnsTogether = 64;  // white ones that stay in the cache

// Products with jumps at each row.
RowMajorMatrix sums_from_each_row(RowMajorMatrix columns) {
  for (Eigen::Index i = columns.rows() - 2; i >= 0; --i) columns.row(i) += columns.row(i + 1);
  return columns;
}

}  // namespace

ProjectedColumns::ProjectedColumns(const Problem& problem, const Identities& identities, const LinearModel& model,
                                   const NoiseFilter& filter)
    : identities_(identities), whitening_(filter.whitening), is_flat_(model.is_flat) {
  const Eigen::Index n = model.columns.rows(), c = identities.columns.cols();
  const RowMajorMatrix own = whitened_rows(whitening_, model.columns);
  gram_ = {static_cast<Eigen::Index>(whitening_.readings()), whitening_.log_determinant(), own.transpose() * own};
  cross_ = Eigen::MatrixXd::Zero(own.cols(), identities.size());
  squares_ = Eigen::VectorXd::Zero(identities.size());
  for (Eigen::Index first = 0; first < c; first += kColumnsTogether) {
    const Eigen::Index columns = std::min(kColumnsTogether, c - first);
    const RowMajorMatrix white = whitened_rows(whitening_, identities.columns.middleCols(first, columns));
    cross_.middleCols(first, columns).noalias() = own.transpose() * white;
    squares_.segment(first, columns) = white.colwise().squaredNorm().transpose();
  }
  if (identities.jump) {
    cross_.rightCols(n) = sums_from_each_row(whitening_.transposed(own)).transpose();
    squares_.tail(n) = whitening_.squares_of_steps();
  }
  for (std::size_t s = 0; s < identities.shapes.size(); ++s) {
    const Shape& shape = identities.shapes[s];
    if (shape.width == 1) continue;
    const RowMajorMatrix white = whitened_rows(whitening_, identities.columns.middleCols(shape.first, shape.width));
    blocks_.push_back({s, -1.0, {}, {}, {}, {}, white.transpose() * white});
  }
  const LinearSolution alone = linear_solution(gram_, is_flat_, problem.known);
  degrees = alone.degrees;
  settle(alone.variance);
}

void ProjectedColumns::settle(double variance) {
  if (variance == settled) return;
  const auto p = static_cast<Eigen::Index>(is_flat_.size());
  const NormalFactor factor(gram_.products.bottomRightCorner(p, p), precision_of(is_flat_, variance));
  const auto open = static_cast<double>(std::count(is_flat_.begin(), is_flat_.end(), char{0}));
  constant = -0.5 * gram_.log_determinant - factor.half_log_determinant() + 0.5 * open * std::log(variance);
  const Eigen::VectorXd of_y = factor.explained(gram_.products.col(0).tail(p));
  square = std::max(gram_.products(0, 0) - of_y.squaredNorm(), 1e-300);
  if (cross_.cols() == 0) {  // Eigen takes no rows of a matrix without columns
    explained_.resize(p, 0);
    along.resize(0);
    left.resize(0);
    settled = variance;
    return;
  }
  explained_ = factor.explained(cross_.bottomRows(p));
  along = cross_.row(0).transpose() - explained_.transpose() * of_y;
  left = squares_ - explained_.colwise().squaredNorm().transpose();
  left = (left.array() > kSurviving * squares_.array()).select(left, 0.0);
  settled = variance;
}

const BlockProduct& ProjectedColumns::block(std::size_t shape) {
  const auto place = std::lower_bound(blocks_.begin(), blocks_.end(), shape,
                                      [](const BlockProduct& one, std::size_t s) { return one.shape < s; });
  BlockProduct& block = *place;
  if (block.settled == settled) return block;
  const Shape& of = identities_.shapes[shape];
  const auto explained = explained_.middleCols(of.first, of.width);
  const Eigen::MatrixXd product = block.white - explained.transpose() * explained;
  block.length = product.diagonal().cwiseMax(1e-300).cwiseSqrt();
  for (Eigen::Index k = 0; k < of.width; ++k) {
    if (left[of.first + k] > 0.0) continue;
    block.length[k] = std::numeric_limits<double>::infinity();  // the model has it
  }
  const Eigen::VectorXd inverse = block.length.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inverse.asDiagonal() * product * inverse.asDiagonal());
  block.vectors = eigen.eigenvectors();
  block.values = eigen.eigenvalues().cwiseMax(0.0);
  for (std::size_t k = 0; k < kGainSizes.size(); ++k) {
    const double g = kGainSizes[k] * kGainSizes[k] / static_cast<double>(of.width);
    block.half_log_width[k] = 0.5 * (g * block.values.array()).log1p().sum();
  }
  block.settled = settled;
  return block;
}

ProjectedColumns::Curve ProjectedColumns::curve_of(
    const std::vector<std::pair<Eigen::Index, double>>& coefficients) const {
  Curve curve{Eigen::VectorXd::Zero(identities_.columns.rows()), Eigen::VectorXd::Zero(explained_.rows())};
  if (coefficients.empty()) return curve;
  for (const auto& [column, coefficient] : coefficients) curve.explained += coefficient * explained_.col(column);
  curve.white = combination_of(identities_, coefficients);
  whitening_.apply(curve.white.data(), 1, curve.white.data(), 1);
  return curve;
}

Eigen::VectorXd ProjectedColumns::products(const Curve& curve, const std::vector<ColumnSpan>& columns) const {
  const Eigen::Index n = identities_.columns.rows(), c = identities_.columns.cols();
  const RowMajorMatrix back = whitening_.transposed(curve.white);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(identities_.size());
  for (const auto& [first, count] : columns) {
    if (first == c && count == n) {  // of jumps
      result.tail(n) = sums_from_each_row(back).col(0);
    } else {
      result.segment(first, count).noalias() = identities_.columns.middleCols(first, count).transpose() * back.col(0);
    }
    result.segment(first, count).noalias() -= explained_.middleCols(first, count).transpose() * curve.explained;
  }
  return result;
}

}  // namespace ballbar
