#include "diagnosis/evidence/linear_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballbar {
namespace {

constexpr double kJitter = 1e-10;  // added to a diagonal of 1, for nearly equal columns
constexpr int kRounds = 3;         // of the scatter and of the prior in units of it

Eigen::Index flat_columns(const std::vector<char>& is_flat) {
  return std::count(is_flat.begin(), is_flat.end(), char{1});
}

// Sets the factor and S for this diagonal of P; result: what the model explains of y.
Eigen::VectorXd solve(const Gram& gram, const Eigen::VectorXd& precision, LinearSolution& solution) {
  const Eigen::Index p = precision.size();
  solution.factor = NormalFactor(gram.products.bottomRightCorner(p, p), precision);
  Eigen::VectorXd explained = solution.factor.explained(gram.products.col(0).tail(p));
  solution.square = std::max(gram.products(0, 0) - explained.squaredNorm(), 1e-300);
  return explained;
}

double degrees_of(const Gram& gram, const std::vector<char>& is_flat) {
  return std::max(1.0, static_cast<double>(gram.rows - flat_columns(is_flat)));
}

}  // namespace

LinearModel with_columns(LinearModel model, const Eigen::MatrixXd& columns, bool are_flat) {
  const Eigen::Index first = model.columns.cols();
  model.columns.conservativeResize(Eigen::NoChange, first + columns.cols());
  model.columns.rightCols(columns.cols()) = columns;
  model.is_flat.resize(model.is_flat.size() + static_cast<std::size_t>(columns.cols()), are_flat ? 1 : 0);
  return model;
}

Gram gram_of(const Whitening& whitening, const RowMajorMatrix& columns) {
  return gram_of_white(whitening, whitened_rows(whitening, columns));
}

Gram gram_of_white(const Whitening& whitening, const RowMajorMatrix& white) {
  Gram result{static_cast<Eigen::Index>(whitening.readings()), whitening.log_determinant(),
              Eigen::MatrixXd::Zero(white.cols(), white.cols())};
  result.products.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
  result.products.triangularView<Eigen::StrictlyUpper>() = result.products.transpose();
  return result;
}

NormalFactor::NormalFactor(Eigen::MatrixXd products, const Eigen::VectorXd& precision) {
  if (products.size() == 0) return;
  products.diagonal() += precision;
  scale_ = products.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  products = scale_.asDiagonal() * products * scale_.asDiagonal();
  products.diagonal().array() += kJitter;
  lower_ = Eigen::LLT<Eigen::MatrixXd>(products).matrixL();
  half_log_determinant_ = lower_.diagonal().array().log().sum() - scale_.array().log().sum();
}

Eigen::MatrixXd NormalFactor::explained(const Eigen::Ref<const Eigen::MatrixXd>& products) const {
  if (products.size() == 0) return products;
  Eigen::MatrixXd result = scale_.asDiagonal() * products;
  lower_.triangularView<Eigen::Lower>().solveInPlace(result);
  return result;
}

Eigen::VectorXd NormalFactor::coefficients(const Eigen::VectorXd& explained) const {
  if (explained.size() == 0) return explained;
  return scale_.asDiagonal() * lower_.transpose().triangularView<Eigen::Upper>().solve(explained);
}

Eigen::MatrixXd NormalFactor::inverse() const {
  if (scale_.size() == 0) return {};
  Eigen::MatrixXd half = scale_.asDiagonal();
  lower_.triangularView<Eigen::Lower>().solveInPlace(half);
  return half.transpose() * half;
}

Eigen::VectorXd precision_of(const std::vector<char>& is_flat, double variance) {
  Eigen::VectorXd precision(static_cast<Eigen::Index>(is_flat.size()));
  for (Eigen::Index k = 0; k < precision.size(); ++k)
    precision[k] = is_flat[static_cast<std::size_t>(k)] != 0 ? 0.0 : variance;
  return precision;
}

LinearSolution linear_solution(const Gram& gram, const std::vector<char>& is_flat, const KnownScatter& known) {
  const auto p = static_cast<Eigen::Index>(is_flat.size());
  LinearSolution result;
  result.degrees = degrees_of(gram, is_flat);
  // The prior of u is in um and therefore needs s; at first it is narrow.
  Eigen::VectorXd precision = precision_of(is_flat, 1e3).cwiseProduct(gram.products.diagonal().tail(p));
  Eigen::VectorXd explained;
  for (int round = 0; round < kRounds; ++round) {
    explained = solve(gram, precision, result);
    result.variance = (result.square + known.readings * known.variance) / (result.degrees + known.readings);
    precision = precision_of(is_flat, result.variance);
  }
  result.coefficients = result.factor.coefficients(explained);
  result.log_evidence =
      -0.5 * gram.log_determinant - result.factor.half_log_determinant() +
      0.5 * static_cast<double>(p - flat_columns(is_flat)) * std::log(result.variance) -
      0.5 * (result.degrees + known.readings) * std::log(result.square + known.readings * known.variance);
  return result;
}

LinearSolution solution_at(const Gram& gram, const std::vector<char>& is_flat, double variance) {
  LinearSolution result;
  result.degrees = degrees_of(gram, is_flat);
  result.variance = variance;
  const Eigen::VectorXd explained = solve(gram, precision_of(is_flat, variance), result);
  result.coefficients = result.factor.coefficients(explained);
  return result;
}

LinearSolution linear_solution(const Whitening& whitening, const LinearModel& model, const KnownScatter& known) {
  return linear_solution(gram_of(whitening, model.columns), model.is_flat, known);
}

Eigen::VectorXd residual_of(const LinearModel& model, const LinearSolution& solution) {
  if (solution.coefficients.size() == 0) return model.columns.col(0);
  return model.columns.col(0) - model.columns.rightCols(solution.coefficients.size()) * solution.coefficients;
}

}  // namespace ballbar
