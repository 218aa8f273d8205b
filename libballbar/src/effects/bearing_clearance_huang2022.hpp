// Huang's clearance, eq. 29 to 32, for values and for jets.
#pragma once

#include <ceres/jet.h>

#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {

// sin alpha of eq. 30. A value beyond -1 or 1: no contact angle does it.
template <class T>
T huang2022_sine_of_contact(double elongation_um, const T& ball_diameter_mm, const T& groove_factor) {
  return std::sin(rad_from_deg(18.0)) - 0.8 * elongation_um / (1000.0 * ball_diameter_mm * (groove_factor - 0.5));
}

// c(dL), um. Where eq. 30 has no value alpha stays at -90 or 90 deg.
template <class T>
T huang2022_clearance_um(double elongation_um, const T& ball_diameter_mm, const T& groove_factor) {
  using std::asin;
  using std::tan;
  const T sine = huang2022_sine_of_contact(elongation_um, ball_diameter_mm, groove_factor);
  T alpha_rad(kPi / 2.0);
  if (sine <= T(-1.0)) {
    alpha_rad = T(-kPi / 2.0);
  } else if (sine < T(1.0)) {
    alpha_rad = asin(sine);
  }
  const T theta_rad = (kPi - (rad_from_deg(18.0) - alpha_rad)) / 2.0 - rad_from_deg(72.0);
  return 0.8 * elongation_um * tan(theta_rad);
}

}  // namespace ballbar
