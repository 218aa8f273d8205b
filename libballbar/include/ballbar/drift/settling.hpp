// When a drift is stable: from which time on it stays within a band of its final value at the same speed.
//
// The drift of a stretch of one speed is one settling curve or two, and noise (t from its first row):
//
//   d(t) = c + a_1 exp(-t / tau_1) + a_2 exp(-t / tau_2),      t_s: the last time with |d(t) - c| = band
//
// One curve and two are fitted by least squares (Levenberg-Marquardt) and averaged by exp(-BIC / 2). Two curves that
// the rows do not tell apart are left out. The sigma of t_s is by the law of propagation from the covariance of the
// fit, with the variance of Student's t. If the residual r_i is autocorrelated, the variance is (1 + r) / (1 - r) times
// as large, r the correlation of neighbouring rows.
//
// Accuracy: of simulated records (tau 10 to 60 min, rows every 1 to 20 min, stretches of 1.5 to 7 tau, noise of 0.05 to
// 0.35 um) t_s is within 2 sigma of the truth in 92 to 97 %. Of more than 2000 rows the means of neighbours are fitted.
//
// Source: averaging over models, J. A. Hoeting et al., Statistical Science 14 (1999).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/drift/measured_drift.hpp"

namespace ballbar {

struct StableTime {
  double band_um = 0.0;
  double time_s = 0.0;  // from the first row of the stretch; 0: from the start
  double sigma_s = 0.0;
  bool reached = false;   // the stretch lasts longer than that
  double final_um = 0.0;  // c - d(0): what the drift of the stretch tends to
  double final_sigma_um = 0.0;
  double share_at_end = 0.0;  // of it, at the last row of the stretch
};

// Of rows with rising times, NaN: a gap. nullopt: fewer than 6 rows; the sigma is above half of the time; or
// the time lies beyond the rows, and they end before three quarters of the final value, where a trend or half a cycle
// look like a curve that settles.
std::optional<StableTime> stable_time(std::span<const double> time_s, std::span<const double> drift_um, double band_um);

struct AxisSettling {
  std::string axis;
  double band_um = 0.0;
  bool is_small = false;  // the whole stretch lies within the band
  std::optional<StableTime> stable;
};

// Of each axis in um over the rows [begin, end) of one speed. Without a speed column the stretch ends where the drift
// leaves the band about its largest value and does not come back, if that is in the second half. band_um: default the
// larger of 2 um and 10 % of the range of the axis.
std::vector<AxisSettling> settling_of(const MeasuredDrift& drift, std::size_t begin, std::size_t end,
                                      std::optional<double> band_um = std::nullopt);

}  // namespace ballbar
