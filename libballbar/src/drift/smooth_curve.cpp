#include "drift/smooth_curve.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

constexpr double kDiffuse = 1e8;                                     // variance of the first state, of the noise
constexpr double kLeastLog = -9.0, kMostLog = 3.0, kStepLog = 0.25;  // of the ratio, per step of the rows
constexpr int kDraws = 60;

using State = Eigen::Vector2d;  // the curve and its slope per step
using Spread = Eigen::Matrix2d;

// The same times and ratio of variances for any values.
class Smoother {
 public:
  // steps: between rows, in units of their median.
  Smoother(const std::vector<double>& steps, double ratio) : steps_(steps), ratio_(ratio) {}

  // -2 ln of the restricted likelihood, the noise's variance by itself.
  double deviance(std::span<const double> values) {
    filter(values);
    return static_cast<double>(values.size() - 2) * std::log(std::max(squares_, 1e-300)) + log_variances_;
  }
  double noise_variance(std::size_t rows) const { return squares_ / static_cast<double>(rows - 2); }

  // The curve of the values, and that of what it leaves (twicing): less bias where the drift bends.
  std::vector<double> curve(std::span<const double> values) {
    std::vector<double> once = smoothed(values), left(values.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = values[i] - once[i];
    const std::vector<double> more = smoothed(left);
    for (std::size_t i = 0; i < left.size(); ++i) once[i] += more[i];
    return once;
  }

 private:
  std::vector<double> smoothed(std::span<const double> values) {
    filter(values);
    std::vector<double> curve(values.size());
    State state = filtered_.back();
    curve.back() = state[0];
    for (std::size_t i = values.size() - 1; i > 0; --i) {
      const Spread gain = spreads_[i - 1] * transition(steps_[i]).transpose() * predicted_spreads_[i].inverse();
      state = filtered_[i - 1] + gain * (state - predicted_[i]);
      curve[i - 1] = state[0];
    }
    return curve;
  }

  static Spread transition(double step) {
    Spread f;
    f << 1.0, step, 0.0, 1.0;
    return f;
  }

  void filter(std::span<const double> values) {
    const std::size_t n = values.size();
    filtered_.resize(n), predicted_.resize(n), spreads_.resize(n), predicted_spreads_.resize(n);
    squares_ = log_variances_ = 0.0;
    State state(values[0], 0.0);
    Spread spread = kDiffuse * Spread::Identity();
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0) {
        const double h = steps_[i];
        const Spread f = transition(h);
        Spread added;
        added << h * h * h / 3.0, h * h / 2.0, h * h / 2.0, h;
        state = f * state;
        spread = f * spread * f.transpose() + ratio_ * added;
      }
      predicted_[i] = state;
      predicted_spreads_[i] = spread;
      const double variance = spread(0, 0) + 1.0, innovation = values[i] - state[0];
      const State gain = spread.col(0) / variance;
      state += gain * innovation;
      spread -= gain * spread.row(0);
      filtered_[i] = state;
      spreads_[i] = spread;
      if (i < 2) continue;  // they tell the first state
      squares_ += innovation * innovation / variance;
      log_variances_ += std::log(variance);
    }
  }

  const std::vector<double>& steps_;
  double ratio_;
  double squares_ = 0.0, log_variances_ = 0.0;
  std::vector<State> filtered_, predicted_;
  std::vector<Spread> spreads_, predicted_spreads_;
};

// The curve; `take(draw, curve)` gets that of each draw of the bootstrap.
template <class Take>
std::vector<double> drawn_curves(std::span<const double> time_s, std::span<const double> values, Take take) {
  const std::size_t n = values.size();
  std::vector<double> steps(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) steps[i] = time_s[i] - time_s[i - 1];
  const double step_s = median_step_s(time_s);
  for (double& step : steps) step /= step_s;
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  for (double log_ratio = kLeastLog; log_ratio <= kMostLog; log_ratio += kStepLog) {
    const double deviance = Smoother(steps, std::pow(10.0, log_ratio)).deviance(values);
    if (deviance < least) least = deviance, best = log_ratio;
  }
  Smoother smoother(steps, std::pow(10.0, best));
  const std::vector<double> curve = smoother.curve(values);
  const double sigma = std::sqrt(smoother.noise_variance(n));
  std::mt19937_64 random(1);
  std::vector<double> noisy(n);
  for (int draw = 0; draw < kDraws; ++draw) {
    for (std::size_t i = 0; i < n; ++i) noisy[i] = curve[i] + sigma * simulation::normal(random);
    take(draw, smoother.curve(noisy));
  }
  return curve;
}

}  // namespace

std::size_t average_blocks(std::vector<double>& time_s, std::vector<double>& values, std::size_t most) {
  const std::size_t block = values.empty() ? 1 : 1 + (values.size() - 1) / most;
  if (block == 1) return 1;
  const std::size_t blocks = values.size() / block;
  for (std::vector<double>* all : {&time_s, &values}) {
    for (std::size_t k = 0; k < blocks; ++k) {
      const auto first = all->begin() + static_cast<long>(k * block);
      (*all)[k] = std::accumulate(first, first + static_cast<long>(block), 0.0) / static_cast<double>(block);
    }
    all->resize(blocks);
  }
  return block;
}

std::vector<Estimate> smooth_ranges(std::span<const double> time_s, std::span<const double> values,
                                    std::span<const std::pair<std::size_t, std::size_t>> windows) {
  const auto range_in = [](std::span<const double> curve, const std::pair<std::size_t, std::size_t>& window) {
    return range_of(curve.subspan(window.first, window.second - window.first));
  };
  Eigen::MatrixXd drawn(kDraws, static_cast<Eigen::Index>(windows.size()));
  const std::vector<double> curve = drawn_curves(time_s, values, [&](int draw, const std::vector<double>& again) {
    for (std::size_t w = 0; w < windows.size(); ++w)
      drawn(draw, static_cast<Eigen::Index>(w)) = range_in(again, windows[w]);
  });
  std::vector<Estimate> ranges;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const auto of_draws = drawn.col(static_cast<Eigen::Index>(w)).array();
    const double own = range_in(curve, windows[w]);
    const double added = of_draws.mean() - own;  // by noise; as uncertain as it is large
    const double scatter = std::sqrt((of_draws - of_draws.mean()).square().sum() / (kDraws - 1.0));
    ranges.push_back({std::max(0.0, own - added), std::hypot(scatter, added)});
  }
  return ranges;
}

std::vector<Estimate> smooth_changes(std::span<const double> time_s, std::span<const double> values,
                                     std::size_t reference) {
  const std::size_t n = values.size();
  std::vector<std::vector<double>> drawn;
  drawn.reserve(kDraws);
  const std::vector<double> curve =
      drawn_curves(time_s, values, [&](int /*draw*/, const std::vector<double>& again) { drawn.push_back(again); });
  std::vector<Estimate> changes(n);
  for (std::size_t i = 0; i < n; ++i) {
    changes[i].value_um = curve[i] - curve[reference];
    double square = 0.0;
    for (const std::vector<double>& again : drawn) {
      const double off = again[i] - again[reference] - changes[i].value_um;
      square += off * off;
    }
    changes[i].sigma_um = std::sqrt(square / kDraws);
  }
  return changes;
}

}  // namespace ballbar
