// What a measurement scatters by when nothing happens: white noise and noise with a memory.
//
//   r_i = s_i + e_i     e white with variance w^2 + sigma_i^2 (sigma_i: stated of row i), s an Ornstein-Uhlenbeck
//   process: variance q^2, correlation exp(-|t_i - t_j| / theta)
//
// On even steps that is ARMA(1,1), without s it is white, without e AR(1); steps may be uneven. The likelihood comes
// from the Kalman filter, O(n). Whitening divides the filter's innovations by their standard deviation: a linear
// operation that is applied to residual and Jacobian alike (generalised least squares).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace ballbar {

struct Noise {
  double white_um = 0.0;            // w
  double correlated_um = 0.0;       // q; 0: none
  double correlation_time_s = 0.0;  // theta
  double log_likelihood = 0.0;
};

// Maximum likelihood. sigma_um: stated, one a row, or empty. Needs 8 residuals; with fewer they are taken as white.
Noise noise_of(std::span<const double> time_s, std::span<const double> residual_um, std::span<const double> sigma_um);

double log_likelihood(const Noise& noise, std::span<const double> time_s, std::span<const double> residual_um,
                      std::span<const double> sigma_um);

// The filter's gains for these times, to be applied to any column.
class Whitening {
 public:
  Whitening(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um);
  // n innovations over their standard deviation. `stride`: distance of the column's values in memory.
  void apply(const double* column, std::size_t stride, double* out, std::size_t out_stride) const;
  std::size_t size() const { return decay_.size(); }

 private:
  std::vector<double> decay_, gain_,
      scale_;  // s predicted = decay * s; s += gain * innovation; out = scale * innovation
};

// Number of independent samples whose mean would be as certain: n for white noise.
double effective_samples(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um);

// The smallest RMSE that a true model could leave.
struct Floor {
  double rms_um = 0.0;
  std::string
      source;  // "repeats", "standstill", "residual (ARMA)", "sigma of the circle fits": a phrase for the report
};

// First of: repeats (stretches between changes of speed with the same speeds before and in them, and the same length to
// a tenth: rms of the difference of their targets since the stretch's start, over sqrt 2); a standstill of at least 20
// rows and 10 min after at least 2 h of rest (rms about a straight line); the noise of the residual: its innovations,
// which a model could not have known from the row before; never below the rms of the stated sigma.
Floor floor_of(std::span<const double> time_s, std::span<const double> target_um, std::span<const double> sigma_um,
               std::span<const double> speed_rpm, const Noise& residual_noise);

}  // namespace ballbar
