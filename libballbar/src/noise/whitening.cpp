#include "noise/whitening.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"
#include "noise/kalman.hpp"

namespace ballbar {

Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  // The filter goes from row to row; columns beside one another fill the time that each step has to wait.
  constexpr Eigen::Index kTogether = 8, kBlockRows = 256;
  const Eigen::Index n = columns.rows();
  Eigen::MatrixXd out(n, columns.cols());
  RowMajorMatrix block(std::min(kBlockRows, n), kTogether);
  Eigen::Index k = 0;
  for (; k + kTogether <= columns.cols(); k += kTogether) {
    Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(kTogether);
    for (Eigen::Index first = 0; first < n; first += kBlockRows) {
      auto part = block.topRows(std::min(kBlockRows, n - first));
      part = columns.block(first, k, part.rows(), kTogether);
      whitening.apply(static_cast<std::size_t>(first), part, state);
      out.block(first, k, part.rows(), kTogether) = part;
    }
  }
  for (; k < columns.cols(); ++k) whitening.apply(columns.col(k).data(), 1, out.col(k).data(), 1);
  return out;
}

bool has_heavy_tails(const Eigen::VectorXd& white) {
  constexpr double kDegrees = 4.0;
  constexpr int kRounds = 20;
  if (white.size() < 2) return false;
  const auto n = static_cast<double>(white.size());
  const Eigen::ArrayXd square = (white.array() - white.mean()).square();
  const double variance = square.mean();
  if (!(variance > 0.0)) return false;
  double scale2 = 0.5 * variance;
  for (int round = 0; round < kRounds; ++round) {
    scale2 = ((kDegrees + 1.0) * square / (kDegrees + square / scale2)).mean();
    if (!(scale2 > 0.0)) return true;  // most of them the same
  }
  const double normal = -0.5 * n * (std::log(2.0 * kPi * variance) + 1.0);
  const double width =
      std::lgamma(0.5 * (kDegrees + 1.0)) - std::lgamma(0.5 * kDegrees) - 0.5 * std::log(kDegrees * kPi * scale2);
  const double student = n * width - 0.5 * (kDegrees + 1.0) * (1.0 + square / (kDegrees * scale2)).log().sum();
  return student > normal;
}

}  // namespace ballbar
