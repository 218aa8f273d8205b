#include "diagnosis/statistics/gaussian_process_alternative.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "ballbar/numerics/parallel.hpp"
#include "ballbar/units.hpp"
#include "noise/kalman.hpp"
#include "numerics/nelder_mead.hpp"

namespace ballbar {
namespace {

// States: s, f, f'.
struct Step {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d q = Eigen::Matrix3d::Zero();
};

Step step_of(double dt_s, const Noise& noise, double amplitude_um, double length_s) {
  const double rate = std::sqrt(3.0) / length_s;
  Step step;
  if (noise.correlated_um > 0.0) step.a(0, 0) = std::exp(-dt_s / noise.correlation_time_s);
  const double decay = std::exp(-rate * dt_s);
  step.a(1, 1) = decay * (1.0 + rate * dt_s);
  step.a(1, 2) = decay * dt_s;
  step.a(2, 1) = -decay * rate * rate * dt_s;
  step.a(2, 2) = decay * (1.0 - rate * dt_s);
  Eigen::Matrix3d stationary = Eigen::Matrix3d::Zero();
  stationary(0, 0) = noise.correlated_um * noise.correlated_um;
  stationary(1, 1) = amplitude_um * amplitude_um;
  stationary(2, 2) = stationary(1, 1) * rate * rate;
  step.q = stationary - step.a * stationary * step.a.transpose();
  return step;
}

// States of every column side by side.
class States {
 public:
  explicit States(Eigen::Index columns) : s_(columns), f_(columns), slope_(columns) {
    s_.setZero();
    f_.setZero();
    slope_.setZero();
  }

  void predict(const Step& step) {
    for (Eigen::Index j = 0; j < s_.size(); ++j) {
      const double f = f_[j];
      s_[j] *= step.a(0, 0);
      f_[j] = step.a(1, 1) * f + step.a(1, 2) * slope_[j];
      slope_[j] = step.a(2, 1) * f + step.a(2, 2) * slope_[j];
    }
  }

  // Readings become innovations times `scale`.
  template <class Row>
  void see(const Eigen::Vector3d& gain, double scale, Row row) {
    for (Eigen::Index j = 0; j < s_.size(); ++j) {
      const double innovation = row[j] - s_[j] - f_[j];
      s_[j] += gain[0] * innovation;
      f_[j] += gain[1] * innovation;
      slope_[j] += gain[2] * innovation;
      row[j] = scale * innovation;
    }
  }

 private:
  Eigen::RowVectorXd s_, f_, slope_;
};

}  // namespace

double log_likelihood(const LinearisedFit& linearised, const Noise& noise, double amplitude_um, double length_s) {
  const Eigen::Index n = linearised.residual_um.size(), p = linearised.model.cols();
  RowMajorMatrix columns(n, p + 1);
  columns << linearised.model, linearised.residual_um;
  States states(p + 1);
  Eigen::Matrix3d variance = Eigen::Matrix3d::Zero(), last = Eigen::Matrix3d::Constant(-1.0);
  Eigen::Vector3d gain = Eigen::Vector3d::Zero();
  Step step;
  double before_s = -1.0, log_variances = 0.0, log_variance = 0.0, scale = 1.0;
  bool steady = false;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const double dt_s = i == 0 ? 0.0 : linearised.time_s[row] - linearised.time_s[row - 1];
    if (i == 0) {
      variance(0, 0) = noise.correlated_um * noise.correlated_um;
      variance(1, 1) = amplitude_um * amplitude_um;
      variance(2, 2) = variance(1, 1) * 3.0 / (length_s * length_s);
    } else {
      if (std::abs(dt_s - before_s) > 1e-9 * dt_s) {
        if (steady) variance -= gain * (variance.col(0) + variance.col(1)).transpose();
        step = step_of(dt_s, noise, amplitude_um, length_s);
        before_s = dt_s;
        steady = false;
      }
      states.predict(step);
      if (!steady) variance = step.a * variance * step.a.transpose() + step.q;
    }
    if (!steady || !linearised.sigma_um.empty()) {
      double white = noise.white_um * noise.white_um;
      if (!linearised.sigma_um.empty()) white += linearised.sigma_um[row] * linearised.sigma_um[row];
      const Eigen::Vector3d seen = variance.col(0) + variance.col(1);
      const double innovation_variance = seen[0] + seen[1] + std::max(white, kLeastVariance_um2);
      scale = 1.0 / std::sqrt(innovation_variance);
      log_variance = std::log(innovation_variance);
      gain = seen / innovation_variance;
      steady = linearised.sigma_um.empty() &&
               (variance - last).cwiseAbs().maxCoeff() <= 1e-13 * variance.cwiseAbs().maxCoeff();
      last = variance;
      variance -= gain * seen.transpose();
      if (steady) variance = last;  // the next prediction is this one
    }
    states.see(gain, scale, columns.row(i));
    log_variances += log_variance;
  }
  const Eigen::MatrixXd gram = columns.transpose() * columns;
  double squares = gram(p, p);
  if (p > 0) {
    const Eigen::VectorXd along = gram.topRightCorner(p, 1);
    squares -= along.dot(gram.topLeftCorner(p, p).ldlt().solve(along));
  }
  return -0.5 * (static_cast<double>(n) * std::log(2.0 * kPi) + log_variances + squares);
}

GaussianProcessAlternative gaussian_process_alternative(const LinearisedFit& linearised, const Noise& start) {
  const double span_s = linearised.time_s.back() - linearised.time_s.front();
  const auto n = static_cast<double>(linearised.residual_um.size());
  const double rms_um = std::max(1e-9, std::sqrt(linearised.residual_um.squaredNorm() / n));
  const double shortest_s = std::max(2.0 * span_s / n, span_s / 500.0);
  const auto noise_at = [&](const std::array<double, 4>& x) {
    Noise noise = start;
    noise.white_um = std::max(start.white_um, 1e-6 * rms_um);
    noise.correlated_um = std::exp(x[2]);
    noise.correlation_time_s = std::exp(x[3]);
    return noise;
  };
  const auto cost = [&](const std::array<double, 4>& x) {
    const double length_s = std::exp(x[1]), time_s = std::exp(x[3]);
    if (length_s < shortest_s || length_s > span_s || time_s > span_s / 6.0 || time_s < 0.2 * span_s / n ||
        std::exp(x[0]) > 100.0 * rms_um || std::exp(x[2]) > 100.0 * rms_um) {
      return 1e30;
    }
    return -log_likelihood(linearised, noise_at(x), std::exp(x[0]), length_s);
  };
  const bool memory = start.correlated_um > 0.0;
  const double correlated = memory ? start.correlated_um : 0.1 * rms_um;
  // Noise with the memory found, and noise of which the smooth curve took the slow part.
  constexpr std::array<double, 2> kParts{0.02, 0.1}, kShorter{1.0, 0.2};
  std::array<Minimum<4>, kParts.size() * kShorter.size()> found;
  in_parallel(found.size(), [&](std::size_t i) {
    const double part = kParts[i / kShorter.size()], shorter = kShorter[i % kShorter.size()];
    const double time_s =
        std::clamp((memory ? start.correlation_time_s : span_s / n) * shorter, 0.3 * span_s / n, 0.15 * span_s);
    const std::array<double, 4> from{std::log(0.7 * rms_um), std::log(std::max(shortest_s * 1.5, part * span_s)),
                                     std::log(std::max(correlated * std::sqrt(shorter), 1e-6 * rms_um)),
                                     std::log(time_s)};
    found[i] = nelder_mead<4>(cost, from, {0.5, 0.5, -0.3, -0.3}, 0.02, 160);
  });
  const Minimum<4>& best = *std::min_element(
      found.begin(), found.end(), [](const Minimum<4>& a, const Minimum<4>& b) { return a.value < b.value; });
  if (!(best.value < 1e30)) return {0.0, 0.0, {}, -1e30};
  return {std::exp(best.x[0]), std::exp(best.x[1]), noise_at(best.x), -best.value};
}

}  // namespace ballbar
