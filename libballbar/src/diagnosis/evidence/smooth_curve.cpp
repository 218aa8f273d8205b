#include "diagnosis/evidence/smooth_curve.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "noise/linear_filter.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kNeighbours = 3;              // on either side
constexpr double kMedianOfSizes = 0.67;             // of a normal distribution, in sigma
constexpr double kBends[] = {0.0, 0.1, 1.0, 10.0};  // of the slope: scatters in a usual step
constexpr double kCostOfBends = 20.0;               // nats: a slope that changes is plain to see

// Integrated random walk x'' = white noise of this spectral density, seen at the observations. States (x, x'); it has
// no stationary variance, so that its gains are not those of a noise (linear_filter.hpp), its steps are.
struct Smoother {
  const std::vector<Observation>& observations;
  const std::vector<double>& bends_s;
  double density, bend = 0.0;  // bend: variance of what a bend adds to the slope

  static Eigen::Matrix2d transition(double dt) { return Eigen::Matrix2d{{1.0, dt}, {0.0, 1.0}}; }
  StateEstimate<2> moved(StateEstimate<2> from, double since_s, double until_s) const {
    const double dt = until_s - since_s;
    const Eigen::Matrix2d added = density * Eigen::Matrix2d{{dt * dt * dt / 3.0, dt * dt / 2.0}, {dt * dt / 2.0, dt}};
    if (bend > 0.0) {
      const auto next = std::lower_bound(bends_s.begin(), bends_s.end(), since_s);
      if (next != bends_s.end() && *next < until_s) from.p(1, 1) += bend;
    }
    return predicted(from, transition(dt), added);
  }
  static StateUpdate<2> with(const StateEstimate<2>& before, const Observation& one) {
    return updated(before, {1.0, 0.0}, one.variance, one.value);
  }
  StateEstimate<2> start() const {
    const double span = observations.back().time_s - observations.front().time_s;
    const double slope = 1e6 / (span * span) + density * span;
    return {{observations.front().value, 0.0}, Eigen::Vector2d(1e6, slope).asDiagonal()};
  }
  // The most likely scatter; the first two observations determine the start of the curve.
  double log_likelihood() const {
    expect_no_interruption();
    double log_variances = 0.0, squares = 0.0;
    StateEstimate<2> now = start();
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (i > 0) now = moved(now, observations[i - 1].time_s, observations[i].time_s);
      const StateUpdate<2> update = with(now, observations[i]);
      now = update.after;
      if (i < 2) continue;
      log_variances += std::log(update.variance);
      squares += update.innovation * update.innovation / update.variance;
    }
    return -0.5 * log_variances -
           0.5 * static_cast<double>(observations.size() - 2) * std::log(std::max(squares, 1e-300));
  }
  // The smoothed curve at rising times: forwards, then Rauch, Tung and Striebel backwards.
  std::vector<double> at(const std::vector<double>& time_s) const {
    struct Step {
      double time_s;
      StateEstimate<2> before, after;
      std::optional<std::size_t> row;  // of time_s
    };
    expect_no_interruption();
    std::vector<Step> steps;
    steps.reserve(time_s.size() + observations.size());
    StateEstimate<2> now = start();
    double last = std::min(observations.front().time_s, time_s.front());
    std::size_t next = 0;
    for (std::size_t i = 0; i <= time_s.size(); ++i) {
      for (; next < observations.size() && (i == time_s.size() || observations[next].time_s <= time_s[i]); ++next) {
        const StateEstimate<2> before = moved(now, last, observations[next].time_s);
        now = with(before, observations[next]).after;
        last = observations[next].time_s;
        steps.push_back({last, before, now, std::nullopt});
      }
      if (i == time_s.size()) break;
      now = moved(now, last, time_s[i]);
      last = time_s[i];
      steps.push_back({last, now, now, i});
    }
    expect_no_interruption();
    std::vector<double> values(time_s.size());
    Eigen::Vector2d smooth = steps.back().after.x;
    for (std::size_t k = steps.size(); k-- > 0;) {
      const StateEstimate<2>& after = steps[k].after;
      const double dt = k + 1 < steps.size() ? steps[k + 1].time_s - steps[k].time_s : 0.0;
      if (dt > 0.0) {
        // x = after + P F' Q^-1 (smooth - before), P after this step, Q before the next
        const StateEstimate<2>& before = steps[k + 1].before;
        smooth = before.p.determinant() > 0.0
                     ? Eigen::Vector2d(after.x + after.p * transition(dt).transpose() *
                                                     (before.p.inverse() * (smooth - before.x)))
                     : after.x;
      }
      if (steps[k].row) values[*steps[k].row] = smooth[0];
    }
    return values;
  }
};

// With the roughness and the bends of the largest likelihood. Beside bends a curve is no rougher than without.
Smoother likeliest(const std::vector<Observation>& observations, const std::vector<double>& bends_s) {
  double most = -std::numeric_limits<double>::infinity();
  const double span = observations.back().time_s - observations.front().time_s;
  const double usual = std::max(span / static_cast<double>(observations.size() - 1), 1e-3);
  Smoother best{observations, bends_s, 0.0};
  double best_step = 0.2 * usual;
  for (const double size : kBends) {
    if (size > 0.0 && bends_s.empty()) break;
    const double cost = size > 0.0 ? kCostOfBends : 0.0;
    for (double step = best_step; step < 0.3 * span; step *= 2.0) {
      // A walk that goes by as much as the scatter in this time.
      const Smoother one{observations, bends_s, 3.0 / (step * step * step), std::pow(size / usual, 2)};
      const double now = one.log_likelihood() - cost;
      if (!(now > most)) continue;
      most = now;
      best.density = one.density;
      best.bend = one.bend;
      best_step = step;
    }
  }
  return best;
}

}  // namespace

std::vector<double> smooth_curve(const std::vector<Observation>& observations, const std::vector<double>& time_s,
                                 const std::vector<double>& bends_s) {
  return likeliest(observations, bends_s).at(time_s);
}

std::vector<double> robust_curve(std::vector<Observation> observations, const std::vector<double>& time_s,
                                 const std::vector<double>& bends_s, const Tuning& tuning) {
  std::vector<double> values;
  values.reserve(observations.size());
  for (const Observation& one : observations) values.push_back(one.value);
  const std::vector<double> spikes = less_running_median(values, kNeighbours);
  std::vector<double> sizes = spikes;
  for (double& one : sizes) one = std::abs(one);
  const double sigma = median(std::move(sizes)) / kMedianOfSizes;
  const auto count = static_cast<Eigen::Index>(spikes.size());
  if (sigma > 0.0 && has_heavy_tails(Eigen::VectorXd::Map(spikes.data(), count))) {
    for (std::size_t i = 0; i < observations.size(); ++i) {
      const std::size_t last = std::min(i + kNeighbours, observations.size() - 1);
      const auto bend =
          std::lower_bound(bends_s.begin(), bends_s.end(), observations[i - std::min(i, kNeighbours)].time_s);
      if (bend != bends_s.end() && *bend <= observations[last].time_s) continue;  // a peak has such observations
      const double factor = (std::pow(spikes[i] / sigma, 2) + tuning.freedom) / (tuning.freedom + 1.0);
      if (factor >= tuning.outlier) observations[i].variance *= factor;
    }
  }
  return smooth_curve(observations, time_s, bends_s);
}

}  // namespace ballbar
