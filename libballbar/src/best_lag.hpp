// The shift of one clock for which two series agree best.
#pragma once

#include <optional>
#include <span>

namespace ballbar {

struct BestLag {
  double shift_s = 0.0;
  double sigma_s = 0.0;  // from the residual at the best shift, or the stated sigma if that is larger, and the slope of
                         // the curve; samples independent
};

// Minimises over the shift the variance of value(t) - curve(t - shift): what a constant explains does not count.
// Shifts up to a quarter of the samples' time are tried, those for which the curve covers two thirds of the samples;
// nothing where the best one is the last that was tried, or the curve bends no more than scatter on a straight line
// seems to. At most 2000 of the samples are used.
std::optional<BestLag> best_lag(std::span<const double> time_s, std::span<const double> value,
                                std::span<const double> curve_time_s, std::span<const double> curve, double max_gap_s,
                                double sigma);

}  // namespace ballbar
