// ISO 230-4 quantities of one circle or of a CCW/CW pair, as instrument software stores them.
#pragma once

#include "ballbar/circle/circle_fit.hpp"
#include "ballbar/circle/recording.hpp"

namespace ballbar {

// One direction. G is the range of radii about the least-squares centre; the extremes are given from the
// fitted radius (circular) and from the nominal length (radial, F), with the angle where they lie.
struct Circularity {
  double circular_deviation_um = 0.0;        // G = max - min, >= 0
  double circular_deviation_sigma_um = 0.0;  // of the two extreme readings and of the centre
  double max_circular_um = 0.0;
  double max_at_deg = 0.0;  // [0, 360)
  double min_circular_um = 0.0;
  double min_at_deg = 0.0;
  double max_radial_um = 0.0;  // F max: from the nominal circle
  double min_radial_um = 0.0;  // F min
};

// `circle`: the least-squares one (CircleOptions::oval = false on an arc) gives the G of ISO 230-4.
// sigma: the extremes are single readings, so each carries the readings' short-term noise
// (sigma of successive differences / sqrt 2); the centre's covariance adds its share. The range of n
// noisy readings is also biased upwards; that is not in sigma.
Circularity circularity(const Recording& recording, const Circle& circle);

// Whether the recordings are the two directions of one test: same plane, same length of the bar, same motion.
bool are_both_directions(const Recording& first, const Recording& second);

// Both directions of one test.
struct Bidirectional {
  double bidirectional_2005_um = 0.0;  // range of all radii about the mean of the two centres
  double bidirectional_1996_um = 0.0;  // the larger of the two G
  double mean_radial_um = 0.0;         // D: mean radius of both minus the nominal length
  double hysteresis_um = 0.0;          // H: largest |r_CCW - r_CW| at one angle, not re-centred
  double hysteresis_at_deg = 0.0;
};

// For H the recordings are interpolated at the CCW angles. Throws Error unless one is CCW and one CW,
// in one plane, with a common part of the arc.
Bidirectional bidirectional(const Recording& first, const Circle& first_circle, const Recording& second,
                            const Circle& second_circle);

}  // namespace ballbar
