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

// Elongation of the spindle in a spindle-rotation test (Huang, Li, Zhao 2022, section 4, eq. 34).
//
// While the spindle has grown by dL normal to the plane of the radial test, every length of that test is
// too long, because the bar no longer lies where it lay:
//
//   eq34   dr = r / cos(dL / r) - r                       balls level (h = 0), as printed in the paper
//   exact  dr = sqrt(R^2 + (h + dL)^2) - sqrt(R^2 + h^2)  rho = sqrt(L^2 - (h + dL)^2)
//
// At dL = 20 um, r = 100 mm, h = 0 both give 0.002 um; at h = 5 mm the exact form gives 1.0 um.

enum class ElongationForm { exact, eq34 };

// Size of the correction, um: how much longer the readings of a radial test are than at elongation_um = 0.
// radius_mm > 0 is the in-plane distance R from the axis to the table's ball (exact), or the bar's
// length r (eq34, which ignores height_offset_mm).
double elongation_correction_um(ElongationForm form, double radius_mm, double height_offset_mm, double elongation_um);

}  // namespace ballbar
