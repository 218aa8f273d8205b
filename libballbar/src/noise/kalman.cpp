#include "noise/kalman.hpp"

#include <cmath>
#include <limits>

#include "ballbar/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr double kSameStep = 1e-9;      // relative: rounding of times
constexpr Eigen::Index kLanes = 8;      // parts of a run of rows, side by side
constexpr Eigen::Index kLongRun = 512;  // rows
constexpr double kForgotten = 1e-30;    // share of the first state that counts no more

// s after the rows so far, their decay not yet in it, and sum of v_i^2.
struct Filtered {
  double state = 0.0, squares = 0.0;
};

// v = r - a s,  s after = (1 - gain) a s + gain r: s depends on the one before by one product and one sum.
Filtered filtered(const Kalman::Gain& of, const double* r, Eigen::Index rows, Filtered from) {
  const double keeps = (1.0 - of.gain) * of.decay;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double innovation = r[i] - of.decay * from.state;
    from.squares += innovation * innovation;
    from.state = keeps * from.state + of.gain * r[i];
  }
  return from;
}

// Each row waits for the one before it; equal parts of the rows, side by side, do not. All begin with s = 0, and
// what their first state s adds is known: v_i less a c^i s, c = (1 - gain) a.
Filtered filtered_in_parts(const Kalman::Gain& of, const double* r, Filtered from) {
  using Lanes = Eigen::Array<double, kLanes, 1>;
  const Eigen::Index part = of.rows / kLanes;
  const double keeps = (1.0 - of.gain) * of.decay;
  Lanes state = Lanes::Zero(), squares = Lanes::Zero(), cross = Lanes::Zero();
  double power = of.decay, powers = 0.0;  // a c^i, and the sum of their squares
  const auto row = [&](Eigen::Index i) {
    return Eigen::Map<const Lanes, 0, Eigen::InnerStride<>>(r + i, Eigen::InnerStride<>(part));
  };
  Eigen::Index i = 0;
  for (; i < part && power > kForgotten; ++i) {
    const Lanes now = row(i), innovation = now - of.decay * state;
    squares += innovation.square();
    cross += power * innovation;
    powers += power * power;
    power *= keeps;
    state = keeps * state + of.gain * now;
  }
  for (; i < part; ++i) {
    const Lanes now = row(i), innovation = now - of.decay * state;
    squares += innovation.square();
    state = keeps * state + of.gain * now;
  }
  const double left = power > kForgotten ? std::pow(keeps, static_cast<double>(part)) : 0.0;  // of the first state
  for (Eigen::Index k = 0; k < kLanes; ++k) {
    const double first = from.state;
    from.squares += squares[k] - 2.0 * first * cross[k] + first * first * powers;
    from.state = state[k] + left * first;
  }
  return filtered(of, r + kLanes * part, of.rows - kLanes * part, from);
}

}  // namespace

NoiseVariances variances_of(const Noise& noise) {
  return {noise.white_um * noise.white_um, noise.correlated_um * noise.correlated_um, noise.correlation_time_s};
}

Kalman::Kalman(std::span<const double> time_s, std::span<const double> sigma_um,
               std::span<const std::size_t> left_out) {
  std::vector<double> steps, of_stretches;
  steps.reserve(time_s.size());
  auto next_left_out = left_out.begin();
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    Stretch now{1, sigma_um.empty() ? 0.0 : sigma_um[i] * sigma_um[i], false};
    for (; next_left_out != left_out.end() && *next_left_out == i; ++next_left_out) now.is_left_out = true;
    double step = std::numeric_limits<double>::infinity();
    if (i > 0 && !(time_s[i] < time_s[i - 1])) {
      step = time_s[i] - time_s[i - 1];
      steps.push_back(step);
      const double before = of_stretches.back();
      if (std::abs(step - before) <= kSameStep * before && std::isfinite(before)) step = before;
      Stretch& last = stretches_.back();
      if (step == before && now.stated_um2 == last.stated_um2 && !now.is_left_out && !last.is_left_out) {
        ++last.rows;
        continue;
      }
    }
    stretches_.push_back(now);
    of_stretches.push_back(step);
  }
  step_s_ = Eigen::ArrayXd::Map(of_stretches.data(), static_cast<Eigen::Index>(of_stretches.size()));
  if (steps.empty()) return;
  usual_step_s_ = median(steps);
  shortest_step_s_ = order_statistic(steps, steps.size() / 20);
}

Kalman::Sums Kalman::sums(const NoiseVariances& noise, std::span<const double> residual_um) const {
  const double* r = residual_um.data();
  double squares = 0.0, state = 0.0;
  const double log_variances = for_each_gain(noise, [&](const Gain& of) {
    const Filtered rows =
        of.rows < kLongRun ? filtered(of, r, of.rows, {state, 0.0}) : filtered_in_parts(of, r, {state, 0.0});
    state = rows.state;
    squares += rows.squares * of.weight;
    r += of.rows;
  });
  return {log_variances, squares};
}

}  // namespace ballbar
