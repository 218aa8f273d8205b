#include "predict/likelihood_along_variance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "noise/whitening.hpp"

namespace ballbar {

PriorRoot prior_root(const Eigen::MatrixXd& prior) {
  PriorRoot result;
  std::vector<Eigen::Index> used;
  for (Eigen::Index k = 0; k < prior.rows(); ++k) {
    if (!(prior(k, k) > 0.0)) continue;
    used.push_back(k);
    result.used.push_back(2 + k);
  }
  if (used.empty()) return result;
  const Eigen::LDLT<Eigen::MatrixXd> root(prior(used, used));
  const Eigen::VectorXd lengths = root.vectorD().cwiseMax(0.0).cwiseSqrt();  // P may be singular
  result.factor = root.matrixL();
  result.factor = root.transpositionsP().transpose() * (result.factor * lengths.asDiagonal());
  return result;
}

WhiteProducts white_products(const RidgeProblem& problem, double length_s, double named_variance) {
  const Eigen::Index n = problem.columns.rows();
  RowMajorMatrix white(n, 2 + problem.columns.cols());
  white << Eigen::VectorXd::Ones(n), problem.target_um, problem.columns;
  std::vector<std::size_t> starts;
  for (std::size_t i = 1; i < problem.run.size(); ++i) {
    if (problem.run[i] != problem.run[i - 1]) starts.push_back(i);
  }
  const double memory = remembered(0.0, length_s);
  const Whitening whitening({1.0 - memory, memory, length_s}, problem.time_s, {.starts = starts});
  white = whitened_rows(whitening, std::move(white));
  WhiteProducts result{white.transpose() * white, 0.5 * whitening.log_determinant(), static_cast<double>(n - 1)};
  if (problem.named.empty() || !(named_variance > 0.0)) return result;
  // |N + u X_m X_m'| = |N| u^m |I / u + X_m' N^-1 X_m|
  std::vector<Eigen::Index> named;
  for (const std::size_t k : problem.named) named.push_back(2 + static_cast<Eigen::Index>(k));
  Eigen::MatrixXd of_named = result.inner(named, named);
  of_named.diagonal().array() += 1.0 / named_variance;
  const Eigen::LLT<Eigen::MatrixXd> root(of_named);
  const Eigen::MatrixXd half = root.matrixL().solve(result.inner(named, Eigen::all));
  result.inner -= half.transpose() * half;
  result.half_log_determinant += root.matrixLLT().diagonal().array().log().sum() +
                                 0.5 * static_cast<double>(named.size()) * std::log(named_variance);
  return result;
}

LikelihoodAlongVariance::LikelihoodAlongVariance(const WhiteProducts& products, const PriorRoot& root)
    : inner_(products.inner.topLeftCorner<2, 2>()),
      half_log_determinant_(products.half_log_determinant),
      degrees_(products.degrees) {
  if (root.used.empty()) return;
  const Eigen::Tridiagonalization<Eigen::MatrixXd> reduced(root.factor.transpose() *
                                                           products.inner(root.used, root.used) * root.factor);
  diagonal_ = reduced.diagonal();
  beside_ = reduced.subDiagonal();
  along_ = root.factor.transpose() * products.inner(root.used, Eigen::seqN(0, 2));
  along_.applyOnTheLeft(reduced.matrixQ().adjoint());
}

// I + v T = L D L', row by row.
double LikelihoodAlongVariance::at(double variance) const {
  Eigen::Matrix2d left = inner_;
  Eigen::RowVector2d solved = Eigen::RowVector2d::Zero();
  double half_log_determinant = half_log_determinant_, pivot = 1.0;
  for (Eigen::Index i = 0; i < diagonal_.size(); ++i) {
    const double beside = i == 0 ? 0.0 : variance * beside_[i - 1], factor = beside / pivot;
    pivot = 1.0 + variance * diagonal_[i] - factor * beside;
    solved = along_.row(i) - factor * solved;
    left -= variance / pivot * solved.transpose() * solved;
    half_log_determinant += 0.5 * std::log(pivot);
  }
  const double q = left(0, 0), sum = left(1, 1) - left(0, 1) * left(0, 1) / q;
  const double variance_um2 = std::max(sum / degrees_, std::numeric_limits<double>::min());
  const double result = -0.5 * degrees_ * std::log(variance_um2) - half_log_determinant - 0.5 * std::log(q);
  return std::isfinite(result) ? result : -std::numeric_limits<double>::infinity();
}

}  // namespace ballbar
