// Length of an axial recording: the bar along the spindle axis as a one-dimensional gauge.
#pragma once

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// sigma is that of the mean under the residual's autocorrelation (as in circle_fit.hpp); NaN for one reading.
struct AxialLength {
  double length_mm = 0.0;
  double sigma_um = 0.0;
  double rms_um = 0.0;  // of the readings about their mean
  double autocorrelation = 0.0;
};

// Throws Error for a circle recording or one without readings.
AxialLength axial_length(const Recording& recording);

}  // namespace ballbar
