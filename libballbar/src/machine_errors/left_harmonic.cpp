#include "machine_errors/left_harmonic.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr int kFirst = 5, kLast = 30;  // lower ones are the model's own
constexpr double kClear = 0.001;
constexpr double kPerhaps = 0.5;  // with the noise beside it, it may be clear

struct Wave {
  double cos_um = 0.0, sin_um = 0.0;
  double p_value = 1.0;
};

// Of one recording, kFirst to kLast, each by least squares over the rows that are not at a reversal.
std::vector<Wave> waves_of(const ErrorRows& all, const Eigen::VectorXd& residual,
                           const std::vector<WeightedNoise>& noises, std::size_t recording) {
  constexpr Eigen::Index kWaves = kLast - kFirst + 1;
  std::vector<Eigen::Index> own;
  own.reserve(all.recording.size());
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (all.recording[static_cast<std::size_t>(i)] == recording && all.from_reversal_deg[i] > kAtReversal_deg) {
      own.push_back(i);
    }
  }
  const ErrorRows rows = rows_at(all, own);
  Eigen::MatrixXd columns(rows.size(), 2 * kWaves);
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    // From one wave to the next by a turn of one angle.
    const std::complex<double> turn = std::polar(1.0, rows.angle_rad[i]);
    std::complex<double> wave = std::polar(1.0, kFirst * rows.angle_rad[i]);
    for (Eigen::Index k = 0; k < kWaves; ++k, wave *= turn) {
      columns(i, 2 * k) = wave.real();
      columns(i, 2 * k + 1) = wave.imag();
    }
  }
  const Eigen::MatrixXd weighted = rows.count.asDiagonal() * columns;
  // A line in the spectrum exceeds the likeliest noise, or none does.
  const Eigen::MatrixXd spread = spread_of(weighted, rows, {{1.0, noises.front().noise}});
  const Eigen::VectorXd right = weighted.transpose() * residual(own);
  std::vector<Wave> waves;
  waves.reserve(static_cast<std::size_t>(kWaves));
  for (Eigen::Index k = 0; k < kWaves; ++k) {
    const auto pair = columns.middleCols<2>(2 * k);
    const Eigen::Matrix2d inverse = Eigen::Matrix2d(pair.transpose() * weighted.middleCols<2>(2 * k)).inverse();
    const Eigen::Vector2d wave = inverse * right.segment<2>(2 * k);
    const Eigen::Matrix2d scatter = weighted.middleCols<2>(2 * k).transpose() * spread.middleCols<2>(2 * k);
    const Eigen::Matrix2d covariance = inverse * scatter * inverse;
    const double chi2 = wave.dot(covariance.ldlt().solve(wave));
    waves.push_back({wave[0], wave[1], std::exp(-0.5 * chi2)});
  }
  return waves;
}

// The noise that is left beside this wave too.
std::vector<WeightedNoise> noise_without(const ErrorRows& rows, const Eigen::MatrixXd& columns,
                                         const LeftHarmonic& wave) {
  Eigen::MatrixXd with(columns.rows(), columns.cols() + 2);
  with.leftCols(columns.cols()) = columns;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const double of_it = rows.recording[static_cast<std::size_t>(i)] == wave.recording ? 1.0 : 0.0;
    with(i, columns.cols()) = of_it * std::cos(wave.harmonic * rows.angle_rad[i]);
    with(i, columns.cols() + 1) = of_it * std::sin(wave.harmonic * rows.angle_rad[i]);
  }
  const QuietRows quiet = quiet_rows(rows, with);
  return error_noise(quiet.rows, quiet.columns);
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
  return number == 0 ? kUnknown : std::sqrt(squares / static_cast<double>(number));
}

std::optional<LeftHarmonic> left_harmonic(const ErrorRows& rows, const Eigen::MatrixXd& columns,
                                          const Eigen::VectorXd& residual, const std::vector<WeightedNoise>& noises) {
  std::vector<std::vector<Wave>> waves;
  waves.reserve(rows.recordings);
  for (std::size_t k = 0; k < rows.recordings; ++k) waves.push_back(waves_of(rows, residual, noises, k));
  LeftHarmonic most;
  Wave clearest;
  for (std::size_t recording = 0; recording < rows.recordings; ++recording) {
    for (int harmonic = kFirst; harmonic <= kLast; ++harmonic) {
      const Wave& wave = waves[recording][static_cast<std::size_t>(harmonic - kFirst)];
      if (!(wave.p_value < clearest.p_value)) continue;
      clearest = wave;
      most = {harmonic, recording, 2.0 * std::hypot(wave.cos_um, wave.sin_um), wave.p_value, false};
    }
  }
  if (most.harmonic == 0) return std::nullopt;
  const double looked_at = static_cast<double>(rows.recordings) * (kLast - kFirst + 1);
  if (most.p_value * looked_at >= kClear && most.p_value * looked_at < kPerhaps) {
    const std::vector<WeightedNoise> others = noise_without(rows, columns, most);
    most.p_value =
        waves_of(rows, residual, others, most.recording)[static_cast<std::size_t>(most.harmonic - kFirst)].p_value;
  }
  most.p_value *= looked_at;
  if (!(most.p_value < kClear)) return std::nullopt;
  for (std::size_t recording = 0; recording < rows.recordings; ++recording) {
    if (recording == most.recording) continue;
    const Wave& other = waves[recording][static_cast<std::size_t>(most.harmonic - kFirst)];
    const double along = other.cos_um * clearest.cos_um + other.sin_um * clearest.sin_um;
    const double square = clearest.cos_um * clearest.cos_um + clearest.sin_um * clearest.sin_um;
    if (other.p_value < 0.05 && along > 0.3 * square) most.in_both = true;
  }
  return most;
}

}  // namespace ballbar
