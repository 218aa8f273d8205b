#include "noise/linear_filter.hpp"

#include <cmath>
#include <limits>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr double kSameStep = 1e-9;      // relative: rounding of times
constexpr Eigen::Index kLanes = 8;      // parts of a run of rows, side by side
constexpr Eigen::Index kLongRun = 512;  // rows
constexpr double kForgotten = 1e-30;    // share of the first state that counts no more
constexpr double kSettled = 1e-12;      // of the noise's variance: a change of P that counts no more

// s after the rows so far, their decay not yet in it, and sum of v_i^2.
struct FilterState {
  double state = 0.0, squares = 0.0;
};

// v = r - a s,  s after = (1 - gain) a s + gain r: s depends on the one before by one product and one sum.
FilterState filtered(const FilterGain& of, const double* r, Eigen::Index rows, FilterState from) {
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
FilterState filtered_in_parts(const FilterGain& of, const double* r, Eigen::Index rows, FilterState from) {
  using Lanes = Eigen::Array<double, kLanes, 1>;
  const Eigen::Index part = rows / kLanes;
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
  return filtered(of, r + kLanes * part, rows - kLanes * part, from);
}

// F over a step; an infinite one: nothing is remembered.
Eigen::Matrix3d transition_of(const Covariance& noise, double rate, double step_s) {
  Eigen::Matrix3d transition = Eigen::Matrix3d::Zero();
  if (!std::isfinite(step_s)) return transition;
  const double e = std::exp(-rate * step_s);
  transition(0, 0) = noise.correlated > 0.0 ? std::exp(-step_s / noise.time_s) : 0.0;
  if (noise.slow_is_rough) {
    transition(1, 1) = e;
    return transition;
  }
  transition(1, 1) = e * (1.0 + rate * step_s);
  transition(1, 2) = e * step_s;
  transition(2, 1) = -e * rate * rate * step_s;
  transition(2, 2) = e * (1.0 - rate * step_s);
  return transition;
}

}  // namespace

Covariance variances_of(const Noise& noise) {
  return {noise.white_um * noise.white_um, noise.correlated_um * noise.correlated_um, noise.correlation_time_s};
}

Covariance with_memory(double total, double log_white, double step_s, double memory_s) {
  const double ratio = std::exp(log_white) * -std::expm1(-2.0 * step_s / memory_s);  // w^2 / q^2
  return {total * ratio / (1.0 + ratio), total / (1.0 + ratio), memory_s};
}

std::vector<double> squares_of(std::span<const double> sigma_um) {
  std::vector<double> squares(sigma_um.begin(), sigma_um.end());
  for (double& value : squares) value *= value;
  return squares;
}

LinearFilter::LinearFilter(std::span<const double> time_s, const RowScatter& rows) {
  const auto known = [](std::span<const double> values, std::size_t row, double otherwise) {
    return values.empty() ? otherwise : values[row];
  };
  const auto is_next = [](std::span<const std::size_t>& of, std::size_t row) {
    bool is = false;
    for (; !of.empty() && of.front() == row; of = of.subspan(1)) is = true;
    return is;
  };
  std::span<const std::size_t> left_out = rows.left_out, starts = rows.starts;
  std::vector<double> steps, of_stretches;
  steps.reserve(time_s.size());
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const bool goes_on = !is_next(starts, i) && i > 0 && !(time_s[i] < time_s[i - 1]);
    const double share = known(rows.memory_share, i, 1.0);
    const Stretch now{known(rows.variance, i, 0.0), known(rows.relative_variance, i, 1.0), share,
                      known(rows.memory_variance, i, share * share), is_next(left_out, i)};
    double step = std::numeric_limits<double>::infinity();
    if (goes_on) {
      step = time_s[i] - time_s[i - 1];
      steps.push_back(step);
      const double before = of_stretches.back();
      if (std::abs(step - before) <= kSameStep * before && std::isfinite(before)) step = before;
      if (step == before && stretches_.back().goes_on_with(now)) {
        ++stretches_.back().rows;
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

LinearFilter::Gains LinearFilter::gains_with_discrepancy(const Covariance& noise) const {
  const double rate = (noise.slow_is_rough ? 1.0 : std::sqrt(3.0)) / noise.slow_time_s;
  const double slope_variance = noise.slow_is_rough ? 0.0 : rate * rate * noise.slow;
  const Eigen::Vector3d h(1.0, 1.0, 0.0);
  StateEstimate<3> state{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  Gains gains;
  for (std::size_t k = 0; k < stretches_.size(); ++k) {
    const Stretch& stretch = stretches_[k];
    const Eigen::Matrix3d stationary =
        Eigen::Vector3d(noise.correlated * stretch.share * stretch.share, noise.slow, slope_variance).asDiagonal();
    const Eigen::Matrix3d usual = transition_of(noise, rate, step_s_[static_cast<Eigen::Index>(k)]);
    Eigen::Matrix3d added = stationary - usual * stationary * usual.transpose(), transition = usual, last = added;
    transition(0, 0) *= growth_of_share(k);
    const double white = stretch.white(noise) + noise.correlated * (stretch.own - stretch.share * stretch.share);
    bool settled = false;
    for (Eigen::Index i = 0; i < stretch.rows && !settled; ++i) {
      const StateEstimate<3> before = predicted(state, transition, added);
      const StateUpdate<3> update = updated(before, h, white, 0.0);
      const Eigen::Vector3d gain = stretch.is_left_out ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : update.gain;
      state = stretch.is_left_out ? before : update.after;
      settled = i > 0 && (before.p - last).cwiseAbs().maxCoeff() <= kSettled * (noise.white + noise.correlated);
      const Eigen::Index rows = settled ? stretch.rows - i : 1;
      gains.gain.push_back({transition(0, 0), gain[0], 1.0 / update.variance, transition(1, 1), transition(1, 2),
                            transition(2, 1), transition(2, 2), gain[1], gain[2]});
      gains.rows.push_back(rows);
      gains.log_variances += static_cast<double>(rows) * std::log(update.variance);
      last = before.p;
      transition = usual;
    }
  }
  return gains;
}

LinearFilter::Sums LinearFilter::sums(const Covariance& noise, std::span<const double> residual_um) const {
  const double* r = residual_um.data();
  double squares = 0.0, state = 0.0;
  const double log_variances = for_each_gain(noise, [&](const FilterGain& of, Eigen::Index rows) {
    const FilterState now =
        rows < kLongRun ? filtered(of, r, rows, {state, 0.0}) : filtered_in_parts(of, r, rows, {state, 0.0});
    state = now.state;
    squares += now.squares * of.weight;
    r += rows;
  });
  return {log_variances, squares};
}

}  // namespace ballbar
