// The Kalman filter of noise.hpp for fixed times: what of it does not depend on the readings.
#pragma once

#include <Eigen/Core>
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

  // Gains for this noise. Where step and sigma repeat, the gain converges and is no longer computed.
  void set(const NoiseVariances& noise);

  // Rows in which the gain is the same.
  struct Gain {
    Eigen::Index rows = 1;
    double decay = 0.0, gain = 0.0;
    double weight = 0.0;  // 1 / S_i, S_i the variance of innovation i
  };
  const std::vector<Gain>& gains() const { return gains_; }  // of all rows, as they come

  struct Sums {
    double log_variances = 0.0;  // sum of ln S_i
    double squares = 0.0;        // sum of v_i^2 / S_i, v_i innovation i
  };
  Sums sums(std::span<const double> residual_um) const;

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
  std::vector<Gain> gains_;
  double log_variances_ = 0.0;
};

}  // namespace ballbar
