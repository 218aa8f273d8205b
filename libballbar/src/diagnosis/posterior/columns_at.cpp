#include "diagnosis/posterior/columns_at.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace ballbar {
namespace {

constexpr double kSurviving = 1e-3;            // share of the square of a column that must be left beside the line
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
  pool.col(0) = variant.pool.col(variant.line.y);
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
    blocks.push_back({s, {}, {}, {}, white.transpose() * white});
  }
  // About the scatter that nothing at all leaves.
  double variance = pool_(0, 0) / degrees;
  precision_ = Eigen::VectorXd::Constant(dense, std::numeric_limits<double>::infinity());
  for (int round = 0; round < 3; ++round) {
    settle_line(variance);
    variance = (square + problem.known.readings * problem.known.variance) / (degrees + problem.known.readings);
  }
  if (dense == 0) return;
  // Each of the background's columns shows alike.
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
  settle_line(variance);
}

void ColumnsAt::settle_line(double variance) {
  std::vector<Eigen::Index> used;
  for (Eigen::Index k = 0; k < line_; ++k) used.push_back(k);
  for (Eigen::Index k = 0; k < precision_.size(); ++k) {
    if (std::isfinite(precision_[k])) used.push_back(line_ + k);
  }
  const auto p = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd a(p, p);
  Eigen::VectorXd scale(p);
  double half_log = 0.0;
  for (Eigen::Index i = 0; i < p; ++i) {
    for (Eigen::Index j = 0; j < p; ++j)
      a(i, j) = pool_(1 + used[static_cast<std::size_t>(i)], 1 + used[static_cast<std::size_t>(j)]);
  }
  for (Eigen::Index i = 0; i < p; ++i) {
    const Eigen::Index k = used[static_cast<std::size_t>(i)];
    if (k >= line_) {
      a(i, i) += precision_[k - line_];
      half_log -= 0.5 * std::log(precision_[k - line_]);
    } else if (!is_free_[static_cast<std::size_t>(k)]) {
      a(i, i) += variance;
      half_log -= 0.5 * std::log(variance);
    }
    scale[i] = 1.0 / std::sqrt(std::max(a(i, i), 1e-300));
  }
  a = scale.asDiagonal() * a * scale.asDiagonal();
  a.diagonal().array() += kJitter;
  factor_.compute(a);
  const Eigen::MatrixXd lower = factor_.matrixL();
  for (Eigen::Index i = 0; i < p; ++i) half_log += std::log(lower(i, i)) - std::log(scale[i]);
  constant = -0.5 * log_determinant_ - half_log;
  for (Eigen::Index& k : used) ++k;  // of the pool, behind y
  solved_y_ = scale.asDiagonal() * pool_(used, 0);
  factor_.matrixL().solveInPlace(solved_y_);
  square = std::max(pool_(0, 0) - solved_y_.squaredNorm(), 1e-300);
  used_ = std::move(used);
  scale_ = std::move(scale);
}

void ColumnsAt::settle(double variance) {
  if (variance == settled) return;
  settle_line(variance);
  along = left = squares_;
  if (cross_.cols() > 0) {
    solved_ = scale_.asDiagonal() * cross_(used_, Eigen::all);
    factor_.matrixL().solveInPlace(solved_);
    along = cross_.row(0).transpose() - solved_.transpose() * solved_y_;
    left = squares_ - solved_.colwise().squaredNorm().transpose();
  }
  for (Eigen::Index j = 0; j < left.size(); ++j) {
    if (!(left[j] > kSurviving * squares_[j])) left[j] = 0.0;
  }
  settle_blocks();
  settled = variance;
}

void ColumnsAt::settle_blocks() {
  for (BlockProduct& block : blocks) {
    const Shape& shape = identities_.shapes[block.shape];
    const auto line = solved_.middleCols(shape.first, shape.width);
    const Eigen::MatrixXd product = block.white - line.transpose() * line;
    block.length = product.diagonal().cwiseMax(1e-300).cwiseSqrt();
    for (Eigen::Index k = 0; k < shape.width; ++k) {
      if (left[shape.first + k] > 0.0) continue;
      block.length[k] = std::numeric_limits<double>::infinity();  // the line has it
    }
    const Eigen::VectorXd inverse = block.length.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inverse.asDiagonal() * product * inverse.asDiagonal());
    block.vectors = eigen.eigenvectors();
    block.values = eigen.eigenvalues().cwiseMax(0.0);
  }
}

std::vector<std::pair<std::size_t, double>> ColumnsAt::background_shares(const Eigen::VectorXd& line) const {
  const Eigen::VectorXd coefficients = scale_.asDiagonal() * factor_.matrixU().solve(solved_y_ - line);
  Eigen::VectorXd background = Eigen::VectorXd::Zero(precision_.size());
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (used_[i] > line_) background[used_[i] - 1 - line_] = coefficients[static_cast<Eigen::Index>(i)];
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
  Curve curve{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(scale_.size())};
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
  std::partial_sum(jumps.begin(), jumps.end(), jumps.begin());
  curve.white = whitened_rows(filter_, curve.white + jumps);
  return curve;
}

Eigen::VectorXd ColumnsAt::products(const Curve& curve) const {
  const Eigen::Index n = identities_.columns.rows(), c = identities_.columns.cols();
  const RowMajorMatrix back = filter_.transposed(curve.white);
  Eigen::VectorXd result = -(solved_.transpose() * curve.line);
  result.head(c) += identities_.columns.transpose() * back.col(0);
  if (identities_.jump) result.tail(n) += sums_from_each_row(back).col(0);
  return result;
}

}  // namespace ballbar
