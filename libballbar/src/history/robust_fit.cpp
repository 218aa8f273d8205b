#include "history/robust_fit.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "ballbar/history/history.hpp"
#include "ballbar/units.hpp"

namespace ballbar {

RobustFit robust_fit(const FitColumns& columns, std::span<const double> values, std::span<const double> scatter) {
  constexpr int kMostRounds = 15;
  constexpr double kMoved = 1e-4;  // of a scatter
  const auto n = static_cast<Eigen::Index>(values.size());
  const Eigen::Map<const Eigen::VectorXd> y(values.data(), n), s(scatter.data(), n);
  const Eigen::VectorXd plain = s.cwiseAbs2().cwiseInverse();
  RobustFit fit;
  Eigen::VectorXd weight = plain;
  for (int round = 0; round < kMostRounds; ++round) {
    const FitNormal normal = columns.transpose() * weight.asDiagonal() * columns;
    const FitGains right = columns.transpose() * weight.cwiseProduct(y);
    const Eigen::LDLT<FitNormal> solver(normal);
    fit.gains = solver.solve(right);
    fit.covariance = solver.solve(FitNormal::Identity(columns.cols(), columns.cols()));
    const Eigen::VectorXd scores = (y - columns * fit.gains).cwiseQuotient(s);
    const double moved = round == 0 ? 1.0 : (scores - fit.scores).cwiseAbs().maxCoeff();
    fit.scores = scores;
    if (moved < kMoved || (round == 0 && scores.cwiseAbs().maxCoeff() <= kHuberClip)) break;
    for (Eigen::Index i = 0; i < n; ++i) {
      weight[i] = plain[i] * std::min(1.0, kHuberClip / std::max(std::abs(scores[i]), 1e-300));
    }
  }
  fit.loss = 0.0;
  for (const double z : fit.scores) {
    const double a = std::abs(z);
    fit.loss += a <= kHuberClip ? a * a : kHuberClip * (2.0 * a - kHuberClip);
  }
  return fit;
}

FitColumns trend_columns(std::span<const double> time_s) {
  const double middle_s = 0.5 * (time_s.front() + time_s.back());
  const auto n = static_cast<Eigen::Index>(time_s.size());
  FitColumns columns = FitColumns::Ones(n, 2);
  columns.col(1) = (Eigen::Map<const Eigen::ArrayXd>(time_s.data(), n) - middle_s) / kYear_s;
  return columns;
}

FitColumns season_columns(std::span<const double> time_s) {
  FitColumns columns(static_cast<Eigen::Index>(time_s.size()), 2);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double phase_rad = 2.0 * kPi * time_s[i] / kYear_s;
    columns(static_cast<Eigen::Index>(i), 0) = std::sin(phase_rad);
    columns(static_cast<Eigen::Index>(i), 1) = std::cos(phase_rad);
  }
  return columns;
}

FitColumns step_column(std::size_t n, std::size_t k) {
  FitColumns column = FitColumns::Zero(static_cast<Eigen::Index>(n), 1);
  column.bottomRows(static_cast<Eigen::Index>(n - k)).setOnes();
  return column;
}

FitColumns joined(const FitColumns& left, const FitColumns& right) {
  FitColumns both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

}  // namespace ballbar
