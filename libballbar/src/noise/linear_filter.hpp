// The noise as a linear model with few states, and its Kalman filter for fixed times, as far as it does not depend on
// the readings. All likelihoods, whitenings and grids of correlated noise use this model.
//
//   y_i = h_i s_i + m_i + e_i
//
//   s   the memory, an Ornstein-Uhlenbeck process: variance q^2 (`correlated`), correlation exp(-|dt| / theta)
//   m   the discrepancy: variance `slow`; Matern 3/2 with correlation (1 + u) exp(-u), u = sqrt(3) |dt| / slow_time, or
//       an Ornstein-Uhlenbeck process (`slow_is_rough`) with exp(-|dt| / slow_time)
//   e   white: variance `white` times that of the row, and what is stated of the row
//
// State x = (h s, m, m'): y reads its first two. A row whose time is before the last one's remembers nothing.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/noise/noise.hpp"

namespace ballbar {

inline constexpr double kLeastVariance_um2 = 1e-18;
// A row of this stated variance has no reading: whitening counts it neither in the determinant nor as a reading.
inline constexpr double kUnknownVariance = 1e12;

// Variances in um^2, or in units of the noise's variance (white + correlated = 1).
struct Covariance {
  double white = 1.0, correlated = 0.0, time_s = 0.0;
  double slow = 0.0, slow_time_s = 0.0;  // discrepancy; slow = 0: off
  double log_prior = 0.0;
  bool slow_is_rough = false;
  // Equal but for the prior.
  bool operator==(const Covariance& other) const {
    return white == other.white && correlated == other.correlated && time_s == other.time_s && slow == other.slow &&
           slow_time_s == other.slow_time_s && slow_is_rough == other.slow_is_rough;
  }
};
Covariance variances_of(const Noise& noise);

// White noise and a memory of `total` variance: e^log_white is the white variance over what is new of s in a step.
Covariance with_memory(double total, double log_white, double step_s, double memory_s);

// Properties of each row; empty: defaults. Only the constructor of the filter reads them.
struct RowScatter {
  std::span<const double> variance = {};           // stated: added to the white part
  std::span<const double> relative_variance = {};  // factor on the white part; 1: a normal reading
  std::span<const double> memory_share = {};       // h
  // Variance of the memory in the row, of q^2; h^2 unless given. Of a mean of many readings it is far below h^2: what
  // the row shares with others goes on to grow within it.
  std::span<const double> memory_variance = {};
  std::span<const std::size_t> left_out = {};  // rising rows that are predicted but not used for later rows
  std::span<const std::size_t> starts = {};    // rising rows at which the correlation restarts
};
std::vector<double> squares_of(std::span<const double> sigma_um);

// Mean and covariance of n states.
template <int n>
struct StateEstimate {
  Eigen::Matrix<double, n, 1> x;
  Eigen::Matrix<double, n, n> p;
};

//   x = F x,  P = F P F' + Q
template <int n>
StateEstimate<n> predicted(const StateEstimate<n>& from, const Eigen::Matrix<double, n, n>& transition,
                           const Eigen::Matrix<double, n, n>& added) {
  return {transition * from.x, transition * from.p * transition.transpose() + added};
}

// Updates by a reading of H x with this variance.
template <int n>
struct StateUpdate {
  Eigen::Matrix<double, n, 1> gain;
  double innovation = 0.0, variance = 0.0;  // v, S
  StateEstimate<n> after;
};

//   S = H P H' + R,  K = P H' / S,  x = x + K v,  P = P - K H P
template <int n>
StateUpdate<n> updated(const StateEstimate<n>& before, const Eigen::Matrix<double, n, 1>& h, double variance,
                       double reading) {
  const Eigen::Matrix<double, n, 1> ph = before.p * h;
  StateUpdate<n> update{ph, reading - h.dot(before.x), h.dot(ph) + variance, before};
  update.gain /= update.variance;
  update.after.x += update.gain * update.innovation;
  update.after.p -= update.gain * ph.transpose();
  return update;
}

// Of one row: x before it is F times x after the last one.
struct FilterGain {
  double decay = 0.0, gain = 0.0;
  double weight = 0.0;                                // 1 / S, S the variance of the innovation
  double f00 = 0.0, f01 = 0.0, f10 = 0.0, f11 = 0.0;  // F of the discrepancy
  double gain_slow = 0.0, gain_slope = 0.0;
};

class LinearFilter {
 public:
  explicit LinearFilter(std::span<const double> time_s, const RowScatter& rows = {});

  // Calls take(gain, rows) for all rows as they come, `rows` of the same gain; returns the sum of ln S_i. Where step
  // and row repeat, the gain converges and is the same for all rows from there on.
  template <class Take>
  double for_each_gain(const Covariance& noise, Take&& take) const;

  struct Sums {
    double log_variances = 0.0;  // sum of ln S_i
    double squares = 0.0;        // sum of v_i^2 / S_i, v_i innovation i
  };
  // Of a noise without a discrepancy.
  Sums sums(const Covariance& noise, std::span<const double> residual_um) const;

  double usual_step_s() const { return usual_step_s_; }        // the median; 0: fewer than two times
  double shortest_step_s() const { return shortest_step_s_; }  // all but a twentieth are as long

 private:
  // Rows of the same step that are known alike, or one that is left out.
  struct Stretch {
    double stated = 0.0, relative = 1.0, share = 1.0, own = 1.0;
    bool is_left_out = false;
    Eigen::Index rows = 1;
    bool goes_on_with(const Stretch& next) const {
      return stated == next.stated && relative == next.relative && share == next.share && own == next.own &&
             !is_left_out && !next.is_left_out;
    }
    bool is_mean() const { return own != share * share; }
    double white(const Covariance& noise) const {
      return std::max(noise.white * relative + stated, kLeastVariance_um2);
    }
  };
  struct Gains {
    std::vector<FilterGain> gain;
    std::vector<Eigen::Index> rows;
    double log_variances = 0.0;
  };
  Gains gains_with_discrepancy(const Covariance& noise) const;
  double growth_of_share(std::size_t stretch) const {
    return stretch == 0 ? 1.0 : stretches_[stretch].share / stretches_[stretch - 1].share;
  }

  std::vector<Stretch> stretches_;
  Eigen::ArrayXd step_s_;  // of each stretch; infinite at the start and where time goes back
  double usual_step_s_ = 0.0, shortest_step_s_ = 0.0;
};

// Of the memory alone: s ~ (0, p) before row i:  S = p + R,  gain = p / S,  p after = p R / S;  to the next row
// p = a^2 p + q^2 (1 - a^2). Of a mean S = R + v + a^2 (p - q^2), v the variance of the memory in it: p itself would
// cancel out in it.
template <class Take>
double LinearFilter::for_each_gain(const Covariance& noise, Take&& take) const {
  expect_no_interruption();
  if (noise.slow > 0.0) {
    const Gains gains = gains_with_discrepancy(noise);
    for (std::size_t k = 0; k < gains.gain.size(); ++k) take(gains.gain[k], gains.rows[k]);
    return gains.log_variances;
  }
  constexpr Eigen::Index kDecays = 64;  // taken together
  constexpr int kFactors = 8;           // weights multiplied before a logarithm is taken: none is above 1e18 / um^2
  Eigen::Array<double, kDecays, 1> decay = Eigen::Array<double, kDecays, 1>::Zero();
  double p = 0.0, product = 1.0, log_weights = 0.0;
  int factors = 0;
  for (Eigen::Index k = 0; k < step_s_.size(); ++k) {
    if (k % kDecays == 0 && noise.correlated > 0.0) {
      const Eigen::Index together = std::min(kDecays, step_s_.size() - k);
      decay.head(together) = (step_s_.segment(k, together) * (-1.0 / noise.time_s)).exp();
    }
    const Stretch& stretch = stretches_[static_cast<std::size_t>(k)];
    double a = decay[k % kDecays] * growth_of_share(static_cast<std::size_t>(k));
    const double kept = decay[k % kDecays] * decay[k % kDecays];
    const double added = noise.correlated * stretch.share * stretch.share * (1.0 - kept);
    const double r = stretch.white(noise), own = noise.correlated * stretch.own;
    const double known = noise.correlated * stretch.share * stretch.share * kept;
    double last = -1.0;
    for (Eigen::Index i = 0; i < stretch.rows; ++i) {
      const double before = a * a * p + added;
      const double variance = stretch.is_mean() ? std::max(r + own + (a * a * p - known), r) : before + r;
      const double gain = stretch.is_left_out ? 0.0 : before / variance, weight = 1.0 / variance;
      const double keeps = stretch.is_mean() ? variance - before : r;
      p = stretch.is_left_out ? before : before * keeps / variance;
      if (i > 0 && std::abs(before - last) <= 1e-14 * before) {
        log_weights += static_cast<double>(stretch.rows - i) * std::log(weight);
        take(FilterGain{a, gain, weight}, stretch.rows - i);
        break;
      }
      take(FilterGain{a, gain, weight}, Eigen::Index{1});
      a = decay[k % kDecays];
      last = before;
      product *= weight;
      if (++factors < kFactors) continue;
      log_weights += std::log(product);
      product = 1.0;
      factors = 0;
    }
  }
  return -log_weights - std::log(product);
}

}  // namespace ballbar
