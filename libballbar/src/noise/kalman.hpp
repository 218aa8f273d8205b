// The Kalman filter of noise.hpp for fixed times: what of it does not depend on the readings.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ballbar/noise/noise.hpp"

namespace ballbar {

inline constexpr double kLeastVariance_um2 = 1e-18;

// Variances w^2 and q^2, and theta.
struct NoiseVariances {
  double white = 0.0;
  double correlated = 0.0;
  double time_s = 0.0;
};
NoiseVariances variances_of(const Noise& noise);

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A row, of one column or several, becomes its innovations times `scale`; predicted: s before this row, the last one's
// decay not yet in it, one a column.
template <class Row, class Predicted>
void filter_row(double decay, double gain, double scale, Row&& row, Predicted&& predicted) {
  predicted *= decay;
  row -= predicted;
  predicted += gain * row;
  row *= scale;
}

class Kalman {
 public:
  // left_out: rows, rising, that tell the filter nothing: their innovations are there, but no row after them knows.
  Kalman(std::span<const double> time_s, std::span<const double> sigma_um, std::span<const std::size_t> left_out = {});

  // Rows in which the gain is the same.
  struct Gain {
    Eigen::Index rows = 1;
    double decay = 0.0, gain = 0.0;
    double weight = 0.0;  // 1 / S_i, S_i the variance of innovation i
  };

  // Calls take(gain) for all rows as they come; returns the sum of ln S_i. Where step and sigma repeat, the gain
  // converges and is the same for all rows from there on.
  template <class Take>
  double for_each_gain(const NoiseVariances& noise, Take&& take) const;

  struct Sums {
    double log_variances = 0.0;  // sum of ln S_i
    double squares = 0.0;        // sum of v_i^2 / S_i, v_i innovation i
  };
  Sums sums(const NoiseVariances& noise, std::span<const double> residual_um) const;

  double usual_step_s() const { return usual_step_s_; }        // the median; 0: fewer than two times
  double shortest_step_s() const { return shortest_step_s_; }  // all but a twentieth are as long

 private:
  // Rows of the same step and sigma, or one that is left out.
  struct Stretch {
    Eigen::Index rows = 1;
    double stated_um2 = 0.0;  // sigma_i^2
    bool is_left_out = false;
  };
  std::vector<Stretch> stretches_;
  Eigen::ArrayXd step_s_;  // of each stretch; infinite at the start and where time goes back
  double usual_step_s_ = 0.0, shortest_step_s_ = 0.0;
};

// s ~ (0, p) before row i:  S = p + R,  gain = p / S,  p after = p R / S;  to the next row p = a^2 p + q^2 (1 - a^2).
template <class Take>
double Kalman::for_each_gain(const NoiseVariances& noise, Take&& take) const {
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
    const double a = decay[k % kDecays], a2 = a * a;
    const double r = std::max(noise.white + stretch.stated_um2, kLeastVariance_um2);
    double last = -1.0;
    for (Eigen::Index i = 0; i < stretch.rows; ++i) {
      const double before = a2 * p + noise.correlated * (1.0 - a2), variance = before + r;
      const double gain = stretch.is_left_out ? 0.0 : before / variance, weight = 1.0 / variance;
      p = stretch.is_left_out ? before : before * r / variance;
      if (i > 0 && std::abs(before - last) <= 1e-14 * before) {
        log_weights += static_cast<double>(stretch.rows - i) * std::log(weight);
        take(Gain{stretch.rows - i, a, gain, weight});
        break;
      }
      take(Gain{1, a, gain, weight});
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
