#include "machine_errors/left_harmonic.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

constexpr int kFirst = 5, kLast = 30;  // lower ones are the model's own
constexpr double kClear = 0.01;

struct Wave {
  double cos_um = 0.0, sin_um = 0.0;
  double p_value = 1.0;
};

// By least squares, over the rows that are not at a reversal.
Wave wave_of(const ErrorRows& rows, const Eigen::VectorXd& residual, const std::vector<WeightedNoise>& noises,
             std::size_t recording, int harmonic) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows.size(), 2);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows.size());
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.recording[static_cast<std::size_t>(i)] != recording || rows.from_reversal_deg[i] <= kAtReversal_deg)
      continue;
    columns(i, 0) = std::cos(harmonic * rows.angle_rad[i]);
    columns(i, 1) = std::sin(harmonic * rows.angle_rad[i]);
    weight[i] = rows.count[i];
  }
  const Eigen::MatrixXd weighted = weight.asDiagonal() * columns;
  const Eigen::Matrix2d inverse = (columns.transpose() * weighted).inverse();
  const Eigen::Vector2d wave = inverse * (weighted.transpose() * residual);
  const Eigen::Matrix2d covariance = inverse * scatter_of(weighted, rows, noises) * inverse;
  const double chi2 = wave.dot(covariance.ldlt().solve(wave));
  return {wave[0], wave[1], std::exp(-0.5 * chi2)};
}

}  // namespace

double repeatability_um(const ErrorRows& rows, const Eigen::VectorXd& residual) {
  // Means at each degree of each direction.
  std::map<long, std::pair<double, double>> sums[2];
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const long degree = std::lround(std::floor(deg_from_rad(rows.angle_rad[i])));
    auto& [sum, count] = sums[rows.direction[i] > 0.0 ? 0 : 1][((degree % 360) + 360) % 360];
    sum += rows.count[i] * residual[i];
    count += rows.count[i];
  }
  double squares = 0.0;
  std::size_t number = 0;
  for (const auto& [degree, ccw] : sums[0]) {
    const auto cw = sums[1].find(degree);
    if (cw == sums[1].end()) continue;
    const double difference = ccw.first / ccw.second - cw->second.first / cw->second.second;
    squares += 0.5 * difference * difference;
    ++number;
  }
  return number == 0 ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(squares / static_cast<double>(number));
}

std::optional<LeftHarmonic> left_harmonic(const ErrorRows& rows, const Eigen::VectorXd& residual,
                                          const std::vector<WeightedNoise>& noises, double arc_rad) {
  if (arc_rad < kPi) return std::nullopt;  // waves of a short arc are not told apart
  LeftHarmonic most;
  Wave clearest;
  for (std::size_t recording = 0; recording < rows.recordings; ++recording) {
    for (int harmonic = kFirst; harmonic <= kLast; ++harmonic) {
      const Wave wave = wave_of(rows, residual, noises, recording, harmonic);
      if (wave.p_value >= clearest.p_value) continue;
      clearest = wave;
      most = {harmonic, recording, 2.0 * std::hypot(wave.cos_um, wave.sin_um), wave.p_value, false};
    }
  }
  most.p_value *= static_cast<double>(rows.recordings) * (kLast - kFirst + 1);
  if (!(most.p_value < kClear)) return std::nullopt;
  for (std::size_t recording = 0; recording < rows.recordings; ++recording) {
    if (recording == most.recording) continue;
    const Wave other = wave_of(rows, residual, noises, recording, most.harmonic);
    const double along = other.cos_um * clearest.cos_um + other.sin_um * clearest.sin_um;
    const double square = clearest.cos_um * clearest.cos_um + clearest.sin_um * clearest.sin_um;
    if (other.p_value < 0.05 && along > 0.3 * square) most.in_both = true;
  }
  return most;
}

}  // namespace ballbar
