#include "diagnosis/posterior/columns_at.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

ColumnsAt::ColumnsAt(const Problem& problem, const Identities& identities, const Variant& variant, const Point& point,
                     const DenseBackground& background)
    : identities_(identities),
      filter_(point.filter),
      background_d_(background.d),
      family_of_background_(background.family) {
  const Eigen::Index n = variant.pool.rows(), c = identities.columns.cols();
  const Eigen::Index dense = background.d > 0.0 ? background.columns.cols() : 0;
  line_ = static_cast<Eigen::Index>(variant.line.columns.size());
  is_free_ = variant.line.is_free;
  log_determinant_ = point.filter.log_determinant();
  degrees = std::max(1.0, static_cast<double>(n - std::count(is_free_.begin(), is_free_.end(), char{1})));
  RowMajorMatrix pool(n, 1 + line_ + dense);
  pool.col(0) = variant.pool.col(0);
  for (Eigen::Index k = 0; k < line_; ++k)
    pool.col(1 + k) = variant.pool.col(variant.line.columns[static_cast<std::size_t>(k)]);
  if (dense > 0) pool.rightCols(dense) = background.columns;
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
  precision_ = Eigen::VectorXd::Constant(dense, std::numeric_limits<double>::infinity());
  solve_line();
  for (int round = 0; round < 3; ++round) {
    settle_line(variance);
    variance = (square + problem.known.readings * problem.known.variance) / (degrees + problem.known.readings);
  }
  if (dense == 0) {
    solve_columns();
    return;
  }
  // All columns of the background have the same detectability.
  const Eigen::MatrixXd cross = pool_.block(1, 1 + line_, line_, dense);
  Eigen::MatrixXd a = pool_.block(1, 1, line_, line_);
  for (Eigen::Index k = 0; k < line_; ++k)
    a(k, k) += is_free_[static_cast<std::size_t>(k)] ? kJitter * a(k, k) : variance;
  const Eigen::MatrixXd half = a.llt().matrixL().solve(cross);
  for (Eigen::Index k = 0; k < dense; ++k) {
    const double whole = pool_(1 + line_ + k, 1 + line_ + k), surviving = whole - half.col(k).squaredNorm();
    if (surviving > kSurviving * whole)
      precision_[k] = static_cast<double>(dense) * surviving / (background_d_ * background_d_);
  }
  solve_line();
  settle_line(variance);
  solve_columns();
}

void ColumnsAt::solve_line() {
  fixed_.clear();
  open_.clear();
  for (Eigen::Index k = 0; k < line_; ++k) (is_free_[static_cast<std::size_t>(k)] ? fixed_ : open_).push_back(1 + k);
  for (Eigen::Index k = 0; k < precision_.size(); ++k) {
    if (std::isfinite(precision_[k])) fixed_.push_back(1 + line_ + k);
  }
  Eigen::MatrixXd a = pool_(fixed_, fixed_);
  scale_.resize(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const Eigen::Index k = fixed_[static_cast<std::size_t>(i)];
    if (k > line_) a(i, i) += precision_[k - 1 - line_];
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
  for (Eigen::Index k = 0; k < precision_.size(); ++k) {
    if (std::isfinite(precision_[k])) half_log -= 0.5 * std::log(precision_[k]);
  }
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

std::vector<std::pair<std::size_t, double>> ColumnsAt::background_shares(const Eigen::VectorXd& line) const {
  const auto fixed = static_cast<Eigen::Index>(fixed_.size()), open = static_cast<Eigen::Index>(open_.size());
  const Eigen::VectorXd left_of_y = length_.cwiseProduct(solved_y_) - line;
  const Eigen::VectorXd of_open = turn_ * length_.tail(open).cwiseProduct(left_of_y.tail(open));
  const Eigen::VectorXd coefficients =
      scale_.asDiagonal() * factor_.matrixU().solve(left_of_y.head(fixed) - between_ * of_open);
  Eigen::VectorXd background = Eigen::VectorXd::Zero(precision_.size());
  for (std::size_t i = 0; i < fixed_.size(); ++i) {
    if (fixed_[i] > line_) background[fixed_[i] - 1 - line_] = coefficients[static_cast<Eigen::Index>(i)];
  }
  std::map<std::size_t, std::vector<Eigen::Index>> columns;
  for (std::size_t k = 0; k < family_of_background_.size(); ++k)
    columns[family_of_background_[k]].push_back(static_cast<Eigen::Index>(k));
  std::vector<std::pair<std::size_t, double>> shares;
  double all = 0.0;
  for (const auto& [family, of] : columns) {
    std::vector<Eigen::Index> place;
    for (const Eigen::Index k : of) place.push_back(1 + line_ + k);
    const Eigen::VectorXd b = background(of);
    shares.emplace_back(family, b.dot(pool_(place, place) * b));
    all += shares.back().second;
  }
  for (auto& [family, share] : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
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
