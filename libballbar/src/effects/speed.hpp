// Powers of the speed, shared by the effects that heat or turn with it.
#pragma once

#include <ceres/jet.h>

#include <cmath>

namespace ballbar {

// n^a with n in krpm; 0 at rest, whatever the exponent. The sign of the speed (its direction) does not matter.
template <class T>
T power_of_speed(double speed_rpm, const T& exponent) {
  using std::exp;
  const double krpm = std::abs(speed_rpm) / 1000.0;
  if (krpm < 1e-9) return T(0.0);
  return exp(exponent * std::log(krpm));
}

}  // namespace ballbar
