#include "diagnosis/evidence/evidence.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kJitter = 1e-10;  // of a diagonal of 1: columns that are nearly the same

}  // namespace

double log_sum(std::span<const double> logarithms) {
  double most = -std::numeric_limits<double>::infinity();
  for (const double one : logarithms) most = std::max(most, one);
  if (!std::isfinite(most)) return most;
  double sum = 0.0;
  for (const double one : logarithms) sum += std::exp(one - most);
  return most + std::log(sum);
}

double Solved::log_likelihood(double square_left) const {
  const double least = 1e-12 * square + 1e-300;
  return -0.5 * (degrees + known.readings) * std::log(std::max(square_left, least) + known.readings * known.variance);
}

Solved solved(const Gram& gram, const Line& line, const KnownScatter& known) {
  const auto p = static_cast<Eigen::Index>(line.columns.size());
  Solved result;
  result.known = known;
  const double n_free = static_cast<double>(std::count(line.is_free.begin(), line.is_free.end(), char{1}));
  const Eigen::MatrixXd xx = gram.pool(line.columns, line.columns);
  const Eigen::VectorXd xy = gram.pool(line.columns, Eigen::seqN(line.y, 1));
  const double yy = gram.pool(line.y, line.y);
  result.degrees = std::max(1.0, static_cast<double>(gram.rows) - n_free);
  // The prior of e is in um: it needs s.
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
  const Eigen::Index c = gram.cross.cols();
  if (c == 0) return result;
  Eigen::MatrixXd cross(p, c);
  for (Eigen::Index k = 0; k < p; ++k)
    cross.row(k) = scale[k] * gram.cross.row(line.columns[static_cast<std::size_t>(k)]);
  factor.matrixL().solveInPlace(cross);
  result.along = gram.cross.row(line.y).transpose() - cross.transpose() * white;
  result.left = gram.squares - cross.colwise().squaredNorm().transpose();
  result.cross = std::move(cross);
  return result;
}

double log_evidence(const Solved& base) { return base.constant + base.log_likelihood(base.square); }

double log_evidence(const Solved& base, double left, double along) {
  const double gain = along * along / left;
  std::array<double, kGainSizes.size()> sum;
  for (std::size_t i = 0; i < kGainSizes.size(); ++i) {
    const double d2 = kGainSizes[i] * kGainSizes[i];
    sum[i] = base.log_likelihood(base.square - gain * d2 / (1.0 + d2)) - 0.5 * std::log1p(d2);
  }
  return base.constant + log_sum(sum) - std::log(static_cast<double>(kGainSizes.size()));
}

double log_evidence(const Solved& base, const Eigen::MatrixXd& left, const Eigen::VectorXd& along, double share) {
  const Eigen::Index k = along.size();
  if (k == 0) return log_evidence(base);
  if (k == 1) return log_evidence(base, left(0, 0), along[0]);
  const Eigen::VectorXd scale = left.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd unit = scale.asDiagonal() * left * scale.asDiagonal();
  const Eigen::VectorXd b = scale.asDiagonal() * along;
  std::array<double, kGainSizes.size()> sum;
  for (std::size_t i = 0; i < kGainSizes.size(); ++i) {
    const double d2 = share * kGainSizes[i] * kGainSizes[i];
    Eigen::MatrixXd m = unit;
    m.diagonal().array() += 1.0 / d2;
    const Eigen::LLT<Eigen::MatrixXd> factor(m);
    const Eigen::VectorXd white = factor.matrixL().solve(b);
    const Eigen::MatrixXd lower = factor.matrixL();
    const double half_log =
        lower.diagonal().array().max(1e-12).log().sum() + 0.5 * static_cast<double>(k) * std::log(d2);
    sum[i] = base.log_likelihood(base.square - white.squaredNorm()) - half_log;
  }
  return base.constant + log_sum(sum) - std::log(static_cast<double>(kGainSizes.size()));
}

double log_evidence_of_forms(const Solved& base, const Eigen::MatrixXd& left, const Eigen::VectorXd& along) {
  const Eigen::Index k = along.size();
  const double all = log_evidence(base, left, along, 1.0 / static_cast<double>(k));
  std::vector<double> pairs;
  for (Eigen::Index a = 0; a < k; ++a) {
    for (Eigen::Index b = a + 1; b < k; ++b) {
      const double pair = log_evidence_of_two(base, left(a, a), left(b, b), left(a, b), along[a], along[b]);
      if (std::isfinite(pair)) pairs.push_back(pair);
    }
  }
  if (pairs.empty()) return all;
  const double two = log_sum(pairs) - std::log(static_cast<double>(pairs.size()));
  return log_sum(std::array{all, two}) - std::log(2.0);
}

double log_evidence_of_two(const Solved& base, double aa, double bb, double ab, double along_a, double along_b) {
  const double r = ab / std::sqrt(aa * bb);
  if (!(r * r <= 1.0 - kSurvivingShare)) return -std::numeric_limits<double>::infinity();
  const double x = along_a / std::sqrt(aa), y = along_b / std::sqrt(bb);
  std::array<double, kGainSizes.size()> sum;
  for (std::size_t k = 0; k < kGainSizes.size(); ++k) {
    const double d2 = kGainSizes[k] * kGainSizes[k], m = 1.0 + 1.0 / d2, det = m * m - r * r;
    const double gain = (m * x * x - 2.0 * r * x * y + m * y * y) / det;
    sum[k] = base.log_likelihood(base.square - gain) - 0.5 * std::log(det * d2 * d2);
  }
  return base.constant + log_sum(sum) - std::log(static_cast<double>(kGainSizes.size()));
}

}  // namespace ballbar
