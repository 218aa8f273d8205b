#include "diagnosis/posterior/columns_at.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ballbar {
namespace {

constexpr double kSurviving = 1e-3;            // smallest share of a column's square orthogonal to the line
constexpr double kJitter = 1e-10;              // of a diagonal of 1
constexpr Eigen::Index kColumnsTogether = 64;  // white ones that stay in the cache

// Products with jumps at each row.
RowMajorMatrix sums_from_each_row(RowMajorMatrix columns) {
  for (Eigen::Index i = columns.rows() - 2; i >= 0; --i) columns.row(i) += columns.row(i + 1);
  return columns;
}

}  // namespace

ColumnsAt::ColumnsAt(const Problem& problem, const Identities& identities, const Variant& variant, const Point& point)
    : identities_(identities), filter_(point.filter) {
  const Eigen::Index n = variant.pool.rows(), c = identities.columns.cols();
  line_ = static_cast<Eigen::Index>(variant.line.columns.size());
  is_free_ = variant.line.is_free;
  log_determinant_ = point.filter.log_determinant();
  degrees = std::max(1.0, static_cast<double>(static_cast<Eigen::Index>(point.filter.readings()) -
                                              std::count(is_free_.begin(), is_free_.end(), char{1})));
  RowMajorMatrix pool(n, 1 + line_);
  pool.col(0) = variant.pool.col(0);
  for (Eigen::Index k = 0; k < line_; ++k)
    pool.col(1 + k) = variant.pool.col(variant.line.columns[static_cast<std::size_t>(k)]);
  pool = whitened_rows(filter_, std::move(pool));
  pool_ = pool.transpose() * pool;
  cross_ = Eigen::MatrixXd::Zero(pool.cols(), identities.size());
  squares_ = Eigen::VectorXd::Zero(identities.size());
  for (Eigen::Index first = 0; first < c; first += kColumnsTogether) {
    const Eigen::Index columns = std::min(kColumnsTogether, c - first);
    const RowMajorMatrix white = whitened_rows(filter_, identities.columns.middleCols(first, columns));
    cross_.middleCols(first, columns).noalias() = pool.transpose() * white;
    squares_.segment(first, columns) = white.colwise().squaredNorm().transpose();
  }
  if (identities.jump) {
    cross_.rightCols(n) = sums_from_each_row(filter_.transposed(pool)).transpose();
    squares_.tail(n) = filter_.squares_of_steps();
  }
  for (std::size_t s = 0; s < identities.shapes.size(); ++s) {
    const Shape& shape = identities.shapes[s];
    if (shape.width == 1) continue;
    const RowMajorMatrix white = whitened_rows(filter_, identities.columns.middleCols(shape.first, shape.width));
    blocks_.push_back({s, -1.0, {}, {}, {}, {}, white.transpose() * white});
  }
  // For the scatter without any effect.
  double variance = pool_(0, 0) / degrees;
  solve_line();
  for (int round = 0; round < 3; ++round) {
    settle_line(variance);
    variance = (square + problem.known.readings * problem.known.variance) / (degrees + problem.known.readings);
  }
  solve_columns();
}

void ColumnsAt::solve_line() {
  fixed_.clear();
  open_.clear();
  for (Eigen::Index k = 0; k < line_; ++k) (is_free_[static_cast<std::size_t>(k)] ? fixed_ : open_).push_back(1 + k);
  Eigen::MatrixXd a = pool_(fixed_, fixed_);
  scale_.resize(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    scale_[i] = 1.0 / std::sqrt(std::max(a(i, i), 1e-300));
  }
  a = scale_.asDiagonal() * a * scale_.asDiagonal();
  a.diagonal().array() += kJitter;
  factor_.compute(a);
  between_ = scale_.asDiagonal() * pool_(fixed_, open_);
  if (!open_.empty()) factor_.matrixL().solveInPlace(between_);  // Eigen offsets the null pointer of an empty matrix
  Eigen::MatrixXd b = pool_(open_, open_);
  b.diagonal() *= 1.0 + kJitter;
  b -= between_.transpose() * between_;
  turn_ = b;
  values_.resize(b.rows());
  if (!open_.empty()) {  // the solver takes no matrix of no rows
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(b);
    turn_ = eigen.eigenvectors();
    values_ = eigen.eigenvalues().cwiseMax(0.0);
  }
  solved_y_ = solved_beside(pool_.col(0));
}

// Of columns by their products with the pool: with the fixed columns of the line, and with the open ones.
Eigen::MatrixXd ColumnsAt::solved_beside(const Eigen::Ref<const Eigen::MatrixXd>& products) const {
  const auto fixed = static_cast<Eigen::Index>(fixed_.size()), open = static_cast<Eigen::Index>(open_.size());
  Eigen::MatrixXd solved(fixed + open, products.cols());
  solved.topRows(fixed) = scale_.asDiagonal() * products(fixed_, Eigen::all);
  factor_.matrixL().solveInPlace(solved.topRows(fixed));
  const Eigen::MatrixXd freed = products(open_, Eigen::all) - between_.transpose() * solved.topRows(fixed);
  solved.bottomRows(open).noalias() = turn_.transpose() * freed;
  return solved;
}

void ColumnsAt::solve_columns() {
  along_fixed_ = left_fixed_ = squares_;
  if (cross_.cols() == 0) return;
  const auto fixed = static_cast<Eigen::Index>(fixed_.size());
  solved_ = solved_beside(cross_);
  along_fixed_ = cross_.row(0).transpose() - solved_.topRows(fixed).transpose() * solved_y_.head(fixed);
  left_fixed_ = squares_ - solved_.topRows(fixed).colwise().squaredNorm().transpose();
}

void ColumnsAt::settle_line(double variance) {
  const auto fixed = static_cast<Eigen::Index>(fixed_.size()), open = static_cast<Eigen::Index>(open_.size());
  double half_log = -0.5 * static_cast<double>(open) * std::log(variance);
  const Eigen::MatrixXd lower = factor_.matrixL();
  for (Eigen::Index i = 0; i < fixed; ++i) half_log += std::log(lower(i, i)) - std::log(scale_[i]);
  half_log += 0.5 * (values_.array() + variance).log().sum();
  constant = -0.5 * log_determinant_ - half_log;
  length_ = Eigen::VectorXd::Ones(fixed + open);
  length_.tail(open) = (values_.array() + variance).rsqrt();
  square = std::max(pool_(0, 0) - length_.cwiseProduct(solved_y_).squaredNorm(), 1e-300);
}

void ColumnsAt::settle(double variance) {
  if (variance == settled) return;
  settle_line(variance);
  const auto open = static_cast<Eigen::Index>(open_.size());
  along = along_fixed_;
  left = left_fixed_;
  if (cross_.cols() > 0 && open > 0) {
    const Eigen::VectorXd squares = length_.tail(open).cwiseAbs2();
    const Eigen::VectorXd of_y = squares.cwiseProduct(solved_y_.tail(open));
    for (Eigen::Index j = 0; j < left.size(); ++j) {
      const auto column = solved_.col(j).tail(open);
      along[j] -= column.dot(of_y);
      left[j] -= column.cwiseAbs2().dot(squares);
    }
  }
  for (Eigen::Index j = 0; j < left.size(); ++j) {
    if (!(left[j] > kSurviving * squares_[j])) left[j] = 0.0;
  }
  settled = variance;
}

const BlockProduct& ColumnsAt::block(std::size_t shape) {
  const auto place = std::lower_bound(blocks_.begin(), blocks_.end(), shape,
                                      [](const BlockProduct& one, std::size_t s) { return one.shape < s; });
  BlockProduct& block = *place;
  if (block.settled == settled) return block;
  const Shape& of = identities_.shapes[shape];
  const Eigen::MatrixXd line = length_.asDiagonal() * solved_.middleCols(of.first, of.width);
  const Eigen::MatrixXd product = block.white - line.transpose() * line;
  block.length = product.diagonal().cwiseMax(1e-300).cwiseSqrt();
  for (Eigen::Index k = 0; k < of.width; ++k) {
    if (left[of.first + k] > 0.0) continue;
    block.length[k] = std::numeric_limits<double>::infinity();  // the line has it
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

ColumnsAt::Curve ColumnsAt::curve_of(const std::vector<std::pair<Eigen::Index, double>>& coefficients) const {
  const Eigen::Index n = identities_.columns.rows(), c = identities_.columns.cols();
  Curve curve{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(length_.size())};
  if (coefficients.empty()) return curve;
  Eigen::VectorXd jumps = Eigen::VectorXd::Zero(n);
  for (const auto& [column, coefficient] : coefficients) {
    curve.line += coefficient * solved_.col(column);
    if (column < c) {
      curve.white += coefficient * identities_.columns.col(column);
    } else {
      jumps[column - c] += coefficient;
    }
  }
  curve.line.array() *= length_.array();
  std::partial_sum(jumps.begin(), jumps.end(), jumps.begin());
  curve.white += jumps;
  filter_.apply(curve.white.data(), 1, curve.white.data(), 1);
  return curve;
}

Eigen::VectorXd ColumnsAt::products(const Curve& curve, const std::vector<ColumnSpan>& columns) const {
  const Eigen::Index n = identities_.columns.rows(), c = identities_.columns.cols();
  const RowMajorMatrix back = filter_.transposed(curve.white);
  const Eigen::VectorXd line = length_.cwiseProduct(curve.line);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(identities_.size());
  for (const auto& [first, count] : columns) {
    if (first == c && count == n) {  // of jumps
      result.tail(n) = sums_from_each_row(back).col(0);
    } else {
      result.segment(first, count).noalias() = identities_.columns.middleCols(first, count).transpose() * back.col(0);
    }
    result.segment(first, count).noalias() -= solved_.middleCols(first, count).transpose() * line;
  }
  return result;
}

}  // namespace ballbar
