#include "diagnosis/posterior/set_regression.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ballbar {
namespace {

Eigen::MatrixXd side_by_side(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd all(a.rows(), a.cols() + b.cols());
  all << a, b;
  return all;
}

Eigen::MatrixXd without(const Eigen::MatrixXd& columns, Eigen::Index first, Eigen::Index width) {
  return side_by_side(columns.leftCols(first), columns.rightCols(columns.cols() - first - width));
}

}  // namespace

Eigen::MatrixXd SetRegression::white(const Whitening& filter, const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(white_y.size(), columns.cols());
  result.topRows(columns.rows()) = whitened(filter, columns);
  return result;
}

Eigen::MatrixXd SetRegression::white_columns() const { return side_by_side(white_line, white_members); }

Eigen::MatrixXd SetRegression::white_columns_but(std::size_t member) const {
  return side_by_side(white_line, without(white_members, first[member], width[member]));
}

Eigen::MatrixXd SetRegression::columns_but(std::size_t member) const {
  return side_by_side(line, without(members, first[member], width[member]));
}

SetRegression set_regression(const Problem& problem, const Posterior& posterior, const EffectSet& set) {
  const Point& point = posterior.points[set.point];
  const Variant& variant = posterior.variants[set.variant];
  SetRegression result;
  result.y = variant.pool.col(0);
  result.line = variant.pool(Eigen::all, variant.line.columns);
  const Eigen::Index n = result.y.size();
  Eigen::Index width = 0;
  for (const std::size_t s : set.signatures) {
    result.first.push_back(width);
    result.width.push_back(problem.library.signatures[s].width);
    width += result.width.back();
  }
  result.members.resize(n, width);
  for (std::size_t m = 0; m < set.signatures.size(); ++m) {
    result.members.middleCols(result.first[m], result.width[m]) =
        problem.signatures.middleCols(problem.library.signatures[set.signatures[m]].first, result.width[m]);
  }
  const auto known =
      static_cast<Eigen::Index>(std::count(variant.line.is_free.begin(), variant.line.is_free.end(), char{0}));
  const Eigen::MatrixXd all = side_by_side(result.line, result.members);
  const Eigen::MatrixXd white_all = whitened(point.filter, all);
  const Eigen::VectorXd white_y = whitened(point.filter, result.y);
  result.degrees = std::max(1.0, static_cast<double>(static_cast<Eigen::Index>(point.filter.readings()) -
                                                     result.line.cols() + known - width));
  // Iterates the scatter and the prior of the known columns.
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n + known, all.cols());
  x.topRows(n) = white_all;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + known);
  b.head(n) = white_y;
  result.variance = 0.0;
  for (int round = 0; round < 3; ++round) {
    Eigen::Index row = n;
    for (std::size_t k = 0; k < variant.line.is_free.size(); ++k) {
      if (variant.line.is_free[k] != 0) continue;
      const auto column = static_cast<Eigen::Index>(k);
      x(row++, column) = round == 0 ? 30.0 * white_all.col(column).norm() : std::sqrt(result.variance);
    }
    const Eigen::VectorXd left = b - x * x.completeOrthogonalDecomposition().solve(b);
    result.variance = (left.squaredNorm() + problem.known.readings * problem.known.variance) /
                      (result.degrees + problem.known.readings);
  }
  result.white_y = b;
  result.white_line = x.leftCols(result.line.cols());
  result.white_members = x.rightCols(width);
  return result;
}

}  // namespace ballbar
