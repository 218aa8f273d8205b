#include "noise/kalman.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballbar {
namespace {

constexpr double kSameStep = 1e-9;  // relative: rounding of times

}  // namespace

NoiseVariances variances_of(const Noise& noise) {
  return {noise.white_um * noise.white_um, noise.correlated_um * noise.correlated_um, noise.correlation_time_s};
}

Kalman::Kalman(std::span<const double> time_s, std::span<const double> sigma_um,
               std::span<const std::size_t> left_out) {
  const auto n = static_cast<Eigen::Index>(time_s.size());
  step_s_.setConstant(n, std::numeric_limits<double>::infinity());
  stated_um2_.setZero(n);
  as_before_.assign(time_s.size(), 0);
  left_out_.assign(time_s.size(), 0);
  for (const std::size_t row : left_out) left_out_[row] = 1;
  std::vector<double> steps;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (!sigma_um.empty()) stated_um2_[row] = sigma_um[i] * sigma_um[i];
    if (i == 0 || time_s[i] < time_s[i - 1]) continue;
    double step = time_s[i] - time_s[i - 1];
    steps.push_back(step);
    const double before = step_s_[row - 1];
    if (std::abs(step - before) <= kSameStep * before && std::isfinite(before)) step = before;
    step_s_[row] = step;
    const bool both_in = left_out_[i - 1] == 0 && left_out_[i] == 0;
    as_before_[i] = both_in && step == before && stated_um2_[row] == stated_um2_[row - 1] ? char{1} : char{0};
  }
  const auto even = std::count(as_before_.begin(), as_before_.end(), char{1});
  mostly_even_ = 2 * static_cast<std::size_t>(even) > time_s.size();
  if (steps.empty()) return;
  const auto at = [&](std::size_t k) {
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(k), steps.end());
    return steps[k];
  };
  usual_step_s_ = at(steps.size() / 2);
  shortest_step_s_ = at(steps.size() / 20);
}

// s ~ (0, p) before row i:  S = p + R,  gain = p / S,  p after = p R / S;  to the next row p = a^2 p + q^2 (1 - a^2).
void Kalman::set(const NoiseVariances& noise) {
  constexpr int kFactors = 8;  // variances multiplied before a logarithm is taken: none is below 1e-18 um^2
  const Eigen::Index n = step_s_.size();
  const bool memory = noise.correlated > 0.0;
  if (memory && !mostly_even_) decay_ = (step_s_ * (-1.0 / noise.time_s)).exp();
  if (!memory || mostly_even_) decay_.setZero(n);
  gain_.resize(n);
  weight_.resize(n);
  log_variances_ = 0.0;
  double p = 0.0, last = -1.0, product = 1.0;
  int factors = 0;
  bool converged = false;
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool as_before = as_before_[static_cast<std::size_t>(i)] != 0;
    if (as_before && converged) {
      const auto from = as_before_.begin() + i;
      const Eigen::Index rows = std::find(from, as_before_.end(), char{0}) - from;
      decay_.segment(i, rows).setConstant(decay_[i - 1]);
      gain_.segment(i, rows).setConstant(gain_[i - 1]);
      weight_.segment(i, rows).setConstant(weight_[i - 1]);
      log_variances_ -= static_cast<double>(rows) * std::log(weight_[i - 1]);
      i += rows - 1;
      continue;
    }
    if (mostly_even_ && memory) decay_[i] = as_before ? decay_[i - 1] : std::exp(-step_s_[i] / noise.time_s);
    const double a2 = decay_[i] * decay_[i];
    const double before = a2 * p + noise.correlated * (1.0 - a2);
    const double r = std::max(noise.white + stated_um2_[i], kLeastVariance_um2);
    weight_[i] = 1.0 / (before + r);
    gain_[i] = before * weight_[i];
    p = gain_[i] * r;
    if (left_out_[static_cast<std::size_t>(i)] != 0) {
      gain_[i] = 0.0;
      p = before;
    }
    converged = as_before && std::abs(before - last) <= 1e-14 * before;
    last = before;
    product *= weight_[i];
    if (++factors < kFactors) continue;
    log_variances_ -= std::log(product);
    product = 1.0;
    factors = 0;
  }
  log_variances_ -= std::log(product);
}

// The prediction for the next row, a (s + gain v) = a (1 - gain) s + a gain r, depends on s by one product and one sum.
Kalman::Sums Kalman::sums(std::span<const double> residual_um) const {
  const Eigen::Index n = decay_.size();
  double squares = 0.0, s = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double r = residual_um[static_cast<std::size_t>(i)];
    const double innovation = r - s;
    squares += innovation * innovation * weight_[i];
    const double a = i + 1 < n ? decay_[i + 1] : 0.0;
    s = a * (1.0 - gain_[i]) * s + a * gain_[i] * r;
  }
  return {log_variances_, squares};
}

}  // namespace ballbar
