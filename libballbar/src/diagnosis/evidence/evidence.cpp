#include "diagnosis/evidence/evidence.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ballbar {
namespace {

constexpr double kJitter = 1e-10;  // added to a diagonal of 1, for nearly equal columns

}  // namespace

Gram gram_of(const Whitening& whitening, const RowMajorMatrix& pool) {
  const RowMajorMatrix white = whitened_rows(whitening, pool);
  Gram result{static_cast<Eigen::Index>(whitening.readings()), whitening.log_determinant(),
              Eigen::MatrixXd::Zero(pool.cols(), pool.cols())};
  result.pool.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
  result.pool.triangularView<Eigen::StrictlyUpper>() = result.pool.transpose();
  return result;
}

double log_sum(std::span<const double> logarithms) {
  double most = -std::numeric_limits<double>::infinity();
  for (const double one : logarithms) most = std::max(most, one);
  if (!std::isfinite(most)) return most;
  double sum = 0.0;
  for (const double one : logarithms) sum += std::exp(one - most);
  return most + std::log(sum);
}

double LinearSolution::log_likelihood(double square_left) const {
  const double least = 1e-12 * square + 1e-300;
  return -0.5 * (degrees + known.readings) * std::log(std::max(square_left, least) + known.readings * known.variance);
}

LinearSolution linear_solution(const Gram& gram, const Line& line, const KnownScatter& known) {
  const auto p = static_cast<Eigen::Index>(line.columns.size());
  LinearSolution result;
  result.known = known;
  const double n_free = static_cast<double>(std::count(line.is_free.begin(), line.is_free.end(), char{1}));
  const Eigen::MatrixXd xx = gram.pool(line.columns, line.columns);
  const Eigen::VectorXd xy = gram.pool(line.columns, Eigen::seqN(0, 1));
  const double yy = gram.pool(0, 0);
  result.degrees = std::max(1.0, static_cast<double>(gram.rows) - n_free);
  // The prior of e is in um, and therefore needs s.
  double variance = 0.0;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd scale(p), white(p);
  for (int round = 0; round < 3; ++round) {
    Eigen::MatrixXd a = xx;
    for (Eigen::Index k = 0; k < p; ++k) {
      if (!line.is_free[static_cast<std::size_t>(k)]) a(k, k) += round == 0 ? 1e3 * a(k, k) : variance;
      scale[k] = 1.0 / std::sqrt(std::max(a(k, k), 1e-300));
    }
    a = scale.asDiagonal() * a * scale.asDiagonal();
    a.diagonal().array() += kJitter;
    factor.compute(a);
    white = factor.matrixL().solve(scale.asDiagonal() * xy);
    result.square = std::max(yy - white.squaredNorm(), 1e-300);
    variance = (result.square + known.readings * known.variance) / (result.degrees + known.readings);
  }
  result.variance = variance;
  result.coefficients = scale.asDiagonal() * factor.matrixU().solve(white);
  double half_log = 0.0;
  const Eigen::MatrixXd lower = factor.matrixL();
  for (Eigen::Index k = 0; k < p; ++k) {
    half_log += std::log(lower(k, k)) - std::log(scale[k]);
    if (!line.is_free[static_cast<std::size_t>(k)]) half_log -= 0.5 * std::log(variance);
  }
  result.constant = -0.5 * gram.log_determinant - half_log;
  return result;
}

double log_evidence(const LinearSolution& base) { return base.constant + base.log_likelihood(base.square); }

}  // namespace ballbar
