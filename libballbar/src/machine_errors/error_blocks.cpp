#include "machine_errors/error_blocks.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace ballbar {
namespace {

constexpr double kAbsent = 1e-5;  // mean square of a unit's curve: not in these readings
constexpr double kLeast = 1e-12;  // a column of zeros has an inverse too

}  // namespace

Indices range_of(Eigen::Index first, Eigen::Index count) {
  Indices indices(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = first + static_cast<Eigen::Index>(i);
  return indices;
}

Eigen::MatrixXd inverse_of(Eigen::MatrixXd normal, const Eigen::MatrixXd& precision) {
  normal.diagonal() *= 1.0 + kRidge;
  normal.topLeftCorner(precision.rows(), precision.cols()) += precision;
  normal.diagonal().array() += kLeast;
  return normal.llt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
}

Block block_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weight, const Eigen::MatrixXd& precision) {
  Block block;
  block.weighted = weight.asDiagonal() * columns;
  Eigen::MatrixXd normal(columns.cols(), columns.cols());
  normal.triangularView<Eigen::Lower>() = columns.transpose() * block.weighted;
  block.inverse = inverse_of(normal.selfadjointView<Eigen::Lower>(), precision);
  return block;
}

ErrorColumns present(const ErrorColumns& all, const ErrorRows& rows) {
  const Eigen::VectorXd squares =
      (all.values.array().square().colwise() * rows.count.array()).colwise().sum().transpose() / rows.count.sum();
  Indices kept;
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    if (squares[k] > kAbsent * std::min(1.0, all.fine.col(k).cwiseAbs().maxCoeff())) kept.push_back(k);
  }
  ErrorColumns columns;
  columns.values = all.values(Eigen::all, kept);
  columns.fine = all.fine(Eigen::all, kept);
  columns.columns.reserve(kept.size());
  for (const Eigen::Index k : kept) columns.columns.push_back(all.columns[static_cast<std::size_t>(k)]);
  return columns;
}

double best_shape(const Effect& effect, const std::vector<double>& shapes, const ErrorRows& rows, const Base& base,
                  const Eigen::VectorXd& left, const Eigen::VectorXd& weight) {
  double best = shapes.front(), most = -1.0;
  for (const double shape : shapes) {
    if (shapes.size() == 1) break;
    const ErrorColumns columns = present(effect_columns(effect, shape, rows, false), rows);
    if (columns.size() == 0) continue;
    const Eigen::MatrixXd weighted = weight.asDiagonal() * columns.values;
    Eigen::MatrixXd normal = columns.values.transpose() * weighted;
    if (base.columns != nullptr) {
      const Eigen::MatrixXd shared = base.fit->weighted.transpose() * columns.values;
      normal -= shared.transpose() * base.fit->inverse * shared;
    }
    normal.diagonal() *= 1.0 + kRidge;
    const Eigen::VectorXd seen = weighted.transpose() * left;
    const double lowers = seen.dot(normal.ldlt().solve(seen));
    if (lowers > most) most = lowers, best = shape;
  }
  return best;
}

}  // namespace ballbar
